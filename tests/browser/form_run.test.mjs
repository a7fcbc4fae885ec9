// From a template to a result in the page, with nothing made up: the real orchestrator, the real phases; faults, motions and
// drawings are the service's own.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { until } from "./browser.mjs";
import { field_of, go_to_step, open_groups, write_json } from "./form_page.mjs";
import { live_page } from "./service.mjs";

const study_text = readFileSync(new URL("small_study.json", import.meta.url), "utf8");
const motion = fileURLToPath(new URL("../../workflows/motions/synthetic_short.csv", import.meta.url));

let page;
const live = live_page("form-", { ready: ({ page: opened }) => {
    page = opened;
} });

const field = (pointer) => field_of(page, pointer);
const value = async () => JSON.parse(await page.inputValue("#study"));
const row_of = (control) => page.locator(".field").filter({ has: control });
const screenshot_at = async (name) => {
    for (const width of [1400, 1000, 400]) {
        await page.setViewportSize({ width, height: 900 });
        await page.screenshot({ path: `${process.env.BREACH_BROWSER_BUILD}/screenshots/${name}_${width}.png` });
    }
    await page.setViewportSize({ width: 1400, height: 900 });
};

test("what the service finds wrong stands at its fields, in its variants too", async () => {
    await page.goto(live.service.url);
    await page.click("nav [data-opens=submit]");
    const wrong = JSON.parse(study_text);
    wrong.scene.materials.sand.density = -1800;
    wrong.scene.materials.sand.law.nu = 0.5;
    delete wrong.scene.fem.stages[1].duration;
    wrong.scene.mpm.runout.toe = [1000, 0];
    await write_json(page, JSON.stringify(wrong, null, 4));
    await page.click("#submit");
    await page.waitForSelector("#fault-list li");
    const places = await page.locator("#fault-list code").allTextContents();
    for (const [pointer, said] of [["/scene/materials/sand/density", /-1800/], ["/scene/materials/sand/law/nu", /0.5/]]) {
        assert.ok(places.includes(pointer), `${pointer} in ${places}`);
        const control = await field(pointer);
        assert.match(await row_of(control).locator(".field-faults").textContent(), said);
        assert.equal(await control.getAttribute("aria-invalid"), "true");
    }
    assert.ok((await page.locator("#form .field-faults p").count()) >= places.length, "each fault has a place in the form");
    const duration = await field("/scene/fem/stages/1/duration");
    assert.match(await row_of(duration).locator(".field-faults").textContent(), /lacks "duration"/);
    assert.ok((await page.locator("#study-lines mark").count()) >= 3);
    await screenshot_at("form_faults");

    const doubtful = { ...JSON.parse(study_text), variants: [{ name: "fine", overrides: ["/materials/sand/density=1900"] }, { name: "odd", overrides: ["/materials/sand/density=-3"] }] };
    await write_json(page, JSON.stringify(doubtful, null, 4));
    await page.click("#submit");
    await until("the variant's fault", async () => (await page.locator("#form [data-group=variants] .field-faults p").count()) > 0);
    assert.match(await page.locator("#form .variants-table tbody tr").nth(1).locator(".field-faults").textContent(), /-3/);
});

test("a scene is made from a template, its options are fields, and a bad one is reported at its field", async () => {
    await go_to_step(page, "Section");
    await page.click("#template-choice [value=upstream_dam]");
    await until("the dam, drawn", async () => (await page.locator("#drawing-picture path.region").count()) > 4);
    await page.getByLabel("height", { exact: true }).fill("500");
    await until("the refusal", async () => /500/.test(await row_of(page.getByLabel("height", { exact: true })).locator(".field-faults").textContent()));
    await page.getByLabel("height", { exact: true }).fill("24");
    assert.equal(await page.getByLabel("starter height").getAttribute("placeholder"), "default 8 m");
    await page.getByLabel("raises", { exact: true }).fill("2");
    const regions = async () => (await value()).scene.section.regions.map(({ name }) => name);
    await until("two raises", async () => (await regions()).includes("raise_2") && !(await regions()).includes("raise_3"));
    await until("they are drawn", async () => /raise_2/.test(await page.textContent("#drawing-picture")) && !/raise_3/.test(await page.textContent("#drawing-picture")));
    assert.equal(await page.locator("#drawing-faults li").count(), 0);
    await screenshot_at("form_template");
});

test("a shaken dam's motion is shown, and another one sent in its place", async () => {
    await go_to_step(page, "Water");
    await page.getByLabel("with fem", { exact: true }).selectOption({ label: "yes" });
    await until("a motion", async () => /^file:sha256/.test((await value()).scene.fem?.motion?.file ?? ""));
    const file = await field("/scene/fem/motion/file");
    await until("what it is", async () => /motion.csv: PGA 0.3 g/.test(await row_of(file).locator(".file-state").textContent()));
    const synthetic = (await value()).scene.fem.motion.file;
    await row_of(file).locator("input[type=file]").setInputFiles({ name: "letter.txt", mimeType: "text/plain", buffer: Buffer.from("dear dam,\n") });
    await until("the refusal", async () => /letter.txt/.test(await row_of(file).locator(".file-faults").textContent()));
    assert.equal((await value()).scene.fem.motion.file, synthetic);
    await row_of(file).locator("input[type=file]").setInputFiles(motion);
    await until("another motion", async () => (await value()).scene.fem.motion.file !== synthetic);
    assert.match(await row_of(file).locator(".file-state").textContent(), /^synthetic_short.csv: PGA [\d.]+ g/);
    await until("drawn with its Arias intensity", async () => /synthetic_short|Arias/.test(await page.textContent("#drawing-picture")));
});

test("a scene from a template, changed in the form, runs to its result", async () => {
    await go_to_step(page, "Section");
    await page.click("#template-choice [value=heap]");
    await until("the heap", async () => (await value()).name === "heap");
    await page.getByLabel("height", { exact: true }).fill("10");
    await go_to_step(page, "Question");
    await page.getByLabel("cell size", { exact: true }).fill("0.8");
    await until("its cells", async () => (await value()).scene.mpm.cell_size === 0.8);
    const title = await field("/title");
    await title.fill("A heap of mine");
    await open_groups(page, ["variants"]);
    await page.getByRole("button", { name: "remove variant 2" }).click();
    const { variants } = await value();
    assert.equal(variants.length, 1);
    await (await field("/scene/mpm/floor/friction/0/coefficient")).fill("0.3");
    await page.click("#submit");
    await page.waitForSelector("#run:not([hidden])");
    assert.equal(await page.textContent("#run-title"), "A heap of mine");
    await until("the end of the run", async () => /usable|questionable/.test(await page.textContent("#run-state")), 120000);
    const answer = async (path) => (await fetch(live.service.url + path)).json();
    const { runs: [run] } = await answer("/v1/runs");
    const { rows } = await answer(`/v1/runs/${run.id}/results`);
    assert.equal(rows.length, 1);
    assert.ok(rows[0].runout > 1, `the heap runs out: ${rows[0].runout} m`);
    console.log(`heap of 10 m at friction 0.3: runout ${rows[0].runout.toFixed(2)} m, factor of safety ${rows[0].factor_of_safety?.toFixed(2)}`);
    const { study } = await answer(`/v1/runs/${run.id}`);
    assert.equal((study.scene ?? {}).mpm?.floor.friction[0].coefficient, 0.3);
});

test("a section drawn elsewhere becomes the scene's; what is wrong with the file is drawn and leaves the text alone", async (context) => {
    const routes = await (await fetch(`${live.service.url}/openapi.json`)).json();
    if (!routes.paths["/v1/import"]) return context.skip("this service reads no drawings");
    await page.goto(live.service.url);
    await page.click("nav [data-opens=submit]");
    await write_json(page, study_text);
    const csv = (y) => `region,x,y\nsand,0,0\nsand,40,0\nsand,20,${y}\nsand,0,${y}\n`;
    const send = (text) => page.setInputFiles("#study-file", { name: "slope.csv", mimeType: "text/csv", buffer: Buffer.from(text) });
    await send(csv(10));
    await until("the slope in the scene", async () => (await value()).scene.section.regions[0].polygon.length === 5);
    assert.equal((await value()).scene.materials.sand.density, 1800, "the soils are those that stood there");
    await until("what was guessed", async () => /healed.*guessed: \/section\/element_size/.test(await page.textContent("#options-note")));
    assert.match(await page.textContent("#options-note"), /read in m \(metres, as nothing says otherwise\): the section is 40 m long and 10 m high/);
    const before = await page.inputValue("#study");
    await send(csv(10).replaceAll("sand", "clay"));
    await until("what is wrong", async () => /clay/.test(await page.textContent("#drawing-faults")));
    assert.equal(await page.inputValue("#study"), before);
    assert.ok(await page.locator("#drawing-picture svg").count());
    await page.waitForTimeout(1000); // a drawing of the text that was on its way does not come over it
    assert.match(await page.textContent("#drawing-faults"), /clay/);
    await screenshot_at("form_import");
    await page.getByLabel("map", { exact: true }).fill("clay=sand");
    await until("mapped", async () => (await value()).scene.section.regions[0].name === "clay");
    assert.equal((await value()).scene.section.regions[0].material, "sand");
    await page.click("#form-undo");
    assert.equal(await page.inputValue("#study"), before);
    await page.keyboard.press("Escape");
});

test("a drawn dam is asked for its residual strengths, and becomes a study of static liquefaction", async () => {
    await page.goto(live.service.url);
    await page.click("nav [data-opens=submit]");
    const law = (c_kPa, phi_deg) => ({ density: 1900, law: { type: "mohr_coulomb", E_MPa: 20, nu: 0.3, c_kPa, phi_deg } });
    await write_json(page, JSON.stringify({ format: "breachline-study/1", name: "mine",
        scene: { format: "breachline-scene/1", name: "mine", materials: { ground: law(30, 36), dam: law(8, 34), tailings: law(1, 30) } } }));
    const drawing = "region,x,y\nground,-60,-8\nground,50,-8\nground,50,0\nground,0,0\nground,-36,0\nground,-60,0\n\ndam,-36,0\ndam,0,0\ndam,-24,12\ndam,-28,12\n\n"
        + "tailings,-60,0\ntailings,-36,0\ntailings,-28,12\ntailings,-60,11.5\n\nphreatic,-60,10\nphreatic,-28,9\nphreatic,0,0\nphreatic,50,0\n";
    await page.setInputFiles("#study-file", { name: "dam.csv", mimeType: "text/csv", buffer: Buffer.from(drawing) });
    await until("the dam", async () => (await value()).scene.section?.regions.length === 3);
    await go_to_step(page, "Question");
    await page.getByLabel(/How far does it run, liquefied at rest/).check();
    const strengths = page.getByLabel("liquefied", { exact: true });
    await until("what to enter", async () => /gives no residual strength.*REGION=0.08,SOURCE/s.test(await row_of(strengths).locator(".field-faults").textContent()));
    assert.equal((await value()).scene.mpm, undefined, "the study is as it was");
    await screenshot_at("form_liquefied");
    await strengths.fill("tailings=0.08");
    await until("no source", async () => /names no source/.test(await row_of(strengths).locator(".field-faults").textContent()));
    await strengths.fill("tailings=0.08, CPTu 2024");
    await until("the study", async () => (await value()).variants?.length === 2);
    assert.match(await page.textContent("#options-note"), /residual strength 0.08 sigma'_v0, peak 0.27 sigma'_v0 .*: CPTu 2024/);
    assert.ok(await page.getByLabel(/How far does it run, liquefied at rest/).isChecked());
    await strengths.fill("tailings=0.1, CPTu 2024");
    const ratio = async () => (await value()).scene.materials.tailings_liquefied.strength.peak.ratio;
    await until("another strength", async () => (await ratio()) === 0.1);
    assert.deepEqual((await value()).scene.materials.tailings, law(1, 30), "the soils are still those that were entered");
    await page.getByLabel(/Does an earthquake bring it down/).check();
    await until("asked for layers instead", async () => /no region is cut in layers/.test(await page.textContent("#drawing-faults")));
    await page.getByLabel(/How far does it run, liquefied at rest/).check();
    await page.keyboard.press("Escape");
});

test("nothing failed inside the page", () => {
    assert.deepEqual(live.browser.complaints, []);
    assert.deepEqual(live.browser.foreign, []);
});
