// The form beside the JSON of a new run, against a stand-in server that serves the real schemas.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { open_browser, until } from "./browser.mjs";
import { FakeApi } from "./fake_api.mjs";
import { field_of, go_to_step, open_groups, write_json } from "./form_page.mjs";

const study_text = readFileSync(new URL("small_study.json", import.meta.url), "utf8");
const api = new FakeApi({ pace: 1 });
let page;
let browser;

before(async () => {
    const url = await api.open();
    browser = await open_browser();
    page = browser.page;
    await page.goto(url);
    await page.click("nav [data-opens=submit]");
    await until("the form's beginning", async () => (await page.locator("#form button").count()) === 1);
});
after(async () => {
    await browser.close();
    await api.close();
});

const text_of = () => page.inputValue("#study");
const value = async () => JSON.parse(await text_of());
const field = (pointer) => field_of(page, pointer);
const load = (text) => write_json(page, typeof text === "string" ? text : JSON.stringify(text, null, 4));
/// What differs between two texts: [lines of the first, lines of the second].
function difference(one, other) {
    const [a, b] = [one.split("\n"), other.split("\n")];
    let [head, tail] = [0, 0];
    while (head < a.length && a[head] === b[head]) head += 1;
    while (tail < Math.min(a.length, b.length) - head && a.at(-1 - tail) === b.at(-1 - tail)) tail += 1;
    return [a.slice(head, a.length - tail), b.slice(head, b.length - tail)].map((lines) => lines.map((line) => line.trim()));
}

test("a field of the form changes its place in the text and nothing else; the text changes the field", async () => {
    await load(study_text);
    const density = await field("/scene/materials/sand/density");
    assert.equal(await density.inputValue(), "1800");
    await density.fill("1.95e3");
    assert.deepEqual(difference(study_text, await text_of()), [['"density": 1800,'], ['"density": 1950,']]);
    assert.equal(await density.inputValue(), "1.95e3", "what one types stays as typed");
    await write_json(page, (await text_of()).replace("1950", "2001.5"));
    assert.equal(await density.inputValue(), "2001.5");
    await page.click("#form-undo");
    assert.equal(await text_of(), study_text, "one step back for all that was typed in a field");
});

test("a field says its unit, its range, its default and its help", async () => {
    await load(study_text);
    const shift = await field("/scene/mpm/gimp_half_size");
    assert.equal(await shift.getAttribute("placeholder"), "default 0.25");
    const cell = await field("/scene/mpm/cell_size");
    const row = page.locator(".field").filter({ has: cell });
    assert.equal(await row.locator(".unit").textContent(), "m");
    assert.equal(await row.locator(".range").textContent(), "> 0, ≤ 1000");
    const help = row.locator(".help");
    const narrow = (await help.boundingBox()).height;
    await row.locator("button.more").click();
    assert.ok((await help.boundingBox()).height > 1.5 * narrow, "all of the help is there when asked for");
    assert.match(await help.textContent(), /fewer than 2 are refused/);
    assert.match(await cell.getAttribute("aria-describedby"), new RegExp(await help.getAttribute("id")));
    const stress = await field("/scene/mpm/fill_stress");
    assert.deepEqual(await stress.locator("option").allTextContents(), ["default none", "none", "overburden"]);
    await stress.selectOption({ label: "overburden" });
    assert.equal((await value()).scene.mpm.fill_stress, "overburden");
    await stress.selectOption({ label: "default none" });
    assert.equal("fill_stress" in (await value()).scene.mpm, false);
});

test("what cannot be is said at the field and blocks nothing else; what is not a number never reaches the text", async () => {
    await load(study_text);
    const nu = await field("/scene/materials/sand/law/nu");
    await nu.fill("0.7");
    assert.match(await page.locator(".field").filter({ has: nu }).locator(".doubt").textContent(), /outside of ≥ 0, < 0.5/);
    assert.equal((await value()).scene.materials.sand.law.nu, 0.7);
    await nu.fill("0.2x");
    await nu.blur();
    assert.match(await page.locator(".field").filter({ has: nu }).locator(".doubt").textContent(), /not a number/);
    assert.equal((await value()).scene.materials.sand.law.nu, 0.7);
    const duration = await field("/scene/mpm/duration");
    await duration.fill("until_rest");
    assert.equal((await value()).scene.mpm.duration, "until_rest");
});

test("what the form does not know is kept, and shown", async () => {
    const odd = study_text.replace('"density": 1800,', '"density": 1800,   "own_note" : [ 1,2 ],');
    await load(odd);
    await (await field("/scene/materials/sand/density")).fill("1700");
    assert.deepEqual(difference(odd, await text_of()), [['"density": 1800,   "own_note" : [ 1,2 ],'], ['"density": 1700,   "own_note" : [ 1,2 ],']]);
    assert.equal(await page.locator("#form .unknown code").textContent(), "own_note");
    await load(odd.slice(0, -3));
    assert.match(await page.textContent("#form-note"), /not JSON/);
    assert.ok(await page.$eval("#form", (form) => form.inert));
    await load(odd);
    assert.equal(await page.$eval("#form", (form) => form.inert), false);
});

test("the law of a soil is chosen, and keeps what both laws have", async () => {
    await load(study_text);
    await field("/scene/materials/sand/density");
    const law = page.locator(`#${await page.locator('#form label[title="/scene/materials/sand/law"]').getAttribute("for")}`);
    await law.selectOption({ label: "linear_elastic" });
    assert.deepEqual((await value()).scene.materials.sand.law, { type: "linear_elastic", E_MPa: 20, nu: 0.3, c_kPa: 1, phi_deg: 30 });
    assert.deepEqual(await page.locator("#form .choice .unknown code").allTextContents(), ["c_kPa", "phi_deg"]);
    await page.click("#form-undo");
    assert.equal(await text_of(), study_text);
});

test("rows are added, copied, moved and removed; a renamed soil keeps its uses", async () => {
    await load(study_text);
    await field("/scene/materials/sand/density");
    const name = page.locator('#form details[data-group="materials"] .form-row input').first();
    await name.fill("tailings");
    await name.press("Enter");
    assert.deepEqual(Object.keys((await value()).scene.materials), ["tailings"]);
    assert.equal((await value()).scene.section.regions[0].material, "tailings");
    await field("/scene/fem/stages/0/name");
    const stages = page.locator('#form details[data-group="stages"]');
    const kinds = async () => (await value()).scene.fem.stages.map((stage) => stage.name ?? stage.type);
    await stages.getByRole("button", { name: "move down stage 1" }).click();
    assert.deepEqual(await kinds(), ["failure", "geostatic"]);
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "move down stage 2", "the keyboard goes with the row");
    await stages.getByRole("button", { name: "copy stage 2" }).click();
    await stages.getByRole("button", { name: "remove stage 1" }).click();
    assert.deepEqual(await kinds(), ["geostatic", "geostatic"]);
    await stages.getByRole("button", { name: "Add stage" }).click();
    assert.deepEqual(await kinds(), ["geostatic", "geostatic", "static"]);
    await page.click("#form details[data-group=lem] > summary");
    await page.click('#form button:text-is("Add lem")');
    assert.deepEqual((await value()).scene.lem, {});
});

test("a polygon is a table of points; a closed ring stays closed; a spreadsheet's cells are pasted", async () => {
    await load(study_text);
    await field("/scene/section/regions/0/name");
    await page.click("#form details.points[data-group=polygon] > summary");
    const points = page.locator("#form details.points[data-group=polygon]");
    const ring = async () => (await value()).scene.section.regions[0].polygon;
    await points.getByLabel("polygon, point 1, x").fill("-1");
    assert.deepEqual(await ring(), [[-1, 0], [10, 0], [10, 20], [0, 20], [-1, 0]]);
    await points.locator("tbody tr").nth(1).getByTitle("insert after").click();
    assert.deepEqual((await ring())[2], [10, 10]);
    await points.locator("tbody tr").nth(2).getByTitle("remove").click();
    assert.equal((await ring()).length, 5);
    const paste = (text) => points.getByLabel("polygon, point 1, x").evaluate((cell, pasted) => {
        const data = new DataTransfer();
        data.setData("text", pasted);
        cell.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }));
    }, text);
    await paste("0\t0\n11,5\t0\n6\t8\n0\t0");
    assert.deepEqual((await ring())[1], [11.5, 0], "a decimal comma between tabs");
    await paste("0.0, 0\n12.5, 0\n6, 8\n0, 0");
    const pasted = [[0, 0], [12.5, 0], [6, 8], [0, 0]];
    assert.deepEqual(await ring(), pasted);
    await paste("1,5\n2,5\n3,5");
    assert.deepEqual(await ring(), pasted, "one column of decimal commas is no list of points");
    assert.match(await text_of(), /"polygon": \[\[0, 0\], \[12.5, 0\], \[6, 8\], \[0, 0\]\],\n/);
});

test("faults stand at their field and at their line, live and when refused; the first one is scrolled to", async () => {
    await load(study_text.replace("1800", "-1800").replace('"transfer_times": [0.2, 0.5, 0.8]', '"transfer_times": "soon"'));
    await until("the drawing's fault in the table and at its field", async () => (await page.locator("#form .field-faults p").count()) === 2);
    for (const said of await page.locator("#form .field-faults p").allTextContents()) assert.match(said, /-1800 kg\/m3 is below 0 a soil weighs/);
    assert.deepEqual(await page.locator("#steps .fault-count:visible").allTextContents(), ["1"]);
    const line = study_text.slice(0, study_text.indexOf("1800")).split("\n").length;
    assert.deepEqual(await page.locator("#study-lines mark").allTextContents(), [String(line)]);
    await page.keyboard.press("Control+Enter");
    await page.waitForSelector("#fault-list li");
    assert.match(await page.locator("#fault-list li").nth(1).textContent(), new RegExp(`line ${line}`));
    assert.equal(await page.evaluate(() => document.activeElement.closest(".field")?.querySelector("label").title), "/transfer_times");
    assert.match(await page.evaluate(() => document.activeElement.closest(".field").textContent), /is missing/);
    const density = await field("/scene/materials/sand/density");
    await density.fill("1800");
    await until("nothing is wrong there any more", async () => (await page.locator('#form [data-group=materials] .field-faults p').count()) === 0);
    assert.equal(await page.locator("#study-lines mark").count(), 1, "the other one is still there");
});

test("a motion is sent, named in the scene by its content, and shown; what is none is refused at its field", async () => {
    const shaken = JSON.parse(study_text);
    shaken.scene.fem.motion = { file: "", scale_to_pga_g: 0.2 };
    await load(shaken);
    const file = await field("/scene/fem/motion/file");
    const row = page.locator(".field").filter({ has: file });
    await row.locator("input[type=file]").setInputFiles({ name: "quake.csv", mimeType: "text/csv", buffer: Buffer.from("time_s,acceleration_g\n0,0\n0.1,0.3\n") });
    await until("the reference", async () => /^file:sha256\/[0-9a-f]{64}\.csv$/.test((await value()).scene.fem.motion.file));
    assert.equal(await row.locator(".file-state").textContent(), "quake.csv: PGA 0.31 g, Arias 1.2 m/s");
    const { file: reference } = (await value()).scene.fem.motion;
    await row.locator("input[type=file]").setInputFiles({ name: "empty.csv", mimeType: "text/csv", buffer: Buffer.from("") });
    await until("the refusal", async () => /empty.csv: line 1: no numbers send two columns/.test(await row.locator(".file-faults").textContent()));
    assert.equal((await value()).scene.fem.motion.file, reference, "the scene keeps its motion");
    await row.locator(".drop").evaluate((place) => {
        const data = new DataTransfer();
        data.items.add(new File(["mesh"], "dam.msh"));
        place.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
    });
    await until("another refusal", async () => /dam.msh is a mesh, a motion belongs here/.test(await row.locator(".file-faults").textContent()));
    await load(JSON.stringify({ ...shaken, name: "again" }).replace('"file":""', `"file":"${reference}"`));
    await until("what it is", async () => /quake.csv: PGA/.test(await row.locator(".file-state").textContent()));
});

test("variants are rows, what they change are columns; a sweep makes one for each value; times are a list or a range", async () => {
    await load(study_text);
    await open_groups(page, ["variants"]);
    const table = page.locator("#form details[data-group=variants]");
    await table.getByLabel("parameter").fill("/materials/sand/law/phi_deg");
    await table.getByLabel("values of a sweep").fill("25, 30 35");
    await table.getByRole("button", { name: "Add sweep" }).click();
    assert.deepEqual((await value()).variants, [25, 30, 35].map((phi) => ({ name: `phi_deg_${phi}`, overrides: [`/materials/sand/law/phi_deg=${phi}`] })));
    assert.match(await table.locator("thead").textContent(), /phi_degin the scene: 30 deg/);
    await table.getByLabel("parameter").fill("/mpm/floor/friction/0/coefficient");
    await table.getByRole("button", { name: "Add column" }).click();
    await table.getByLabel("/mpm/floor/friction/0/coefficient of variant 2").fill("0.4");
    await table.getByLabel("name of variant 2").fill("smooth");
    await table.getByLabel("name of variant 2").blur();
    assert.deepEqual((await value()).variants[1], { name: "smooth", overrides: ["/materials/sand/law/phi_deg=30", "/mpm/floor/friction/0/coefficient=0.4"] });
    await table.getByLabel("parameter").fill("/materials/clay/density");
    await table.getByRole("button", { name: "Add column" }).click();
    assert.match(await table.locator(".doubt").textContent(), /no entry \/materials\/clay\/density/);
    await table.getByRole("button", { name: "remove column /materials/sand/law/phi_deg" }).click();
    await table.getByRole("button", { name: "remove variant 1" }).click();
    assert.deepEqual((await value()).variants, [{ name: "smooth", overrides: ["/mpm/floor/friction/0/coefficient=0.4"] }, { name: "phi_deg_35", overrides: [] }]);
    const kind = await field("/transfer_times");
    await kind.selectOption({ label: "an even range" });
    assert.deepEqual((await value()).transfer_times, { from: 0.2, to: 0.8, step: 0.3 });
    await (await field("/transfer_times/step")).fill("0.2");
    await kind.selectOption({ label: "a list" });
    assert.deepEqual((await value()).transfer_times, [0.2, 0.4, 0.6, 0.8]);
});

test("every control of the form has a name, is reached by the keyboard and fits narrow and wide windows", async () => {
    await load(study_text);
    await field("/scene/mpm/cell_size");
    await field("/scene/materials/sand/density");
    const nameless = await page.evaluate(() => [...document.querySelectorAll("#submit-dialog :is(button, input, select, textarea, summary)")]
        .filter((control) => control.checkVisibility())
        .filter((control) => !(control.getAttribute("aria-label") || control.labels?.length || (control.textContent.trim() && control.tagName !== "SELECT")))
        .map((control) => control.outerHTML.slice(0, 120)));
    assert.deepEqual(nameless, []);
    const steps = ["Section", "Soils", "Water", "Question", "Check"];
    const reached = new Set();
    for (const step of steps) {
        await go_to_step(page, step);
        for (let i = 0; i < 40; i += 1) {
            await page.keyboard.press("Tab");
            reached.add(await page.evaluate(() => document.activeElement.dataset.pointer ?? (document.activeElement.closest(".field")?.querySelector("label")?.title || document.activeElement.tagName)));
        }
    }
    for (const place of ["SUMMARY", "/scene/name", "/scene/materials/sand/density", "/scene/materials/sand/law/E_MPa", "/title"]) assert.ok(reached.has(place), `${place} in ${[...reached]}`);
    for (const width of [1400, 1000, 390]) {
        await page.setViewportSize({ width, height: 900 });
        for (const step of steps) {
            await go_to_step(page, step);
            const wide = await page.evaluate(() => [...document.querySelectorAll("#submit-dialog, #submit-dialog *:not(svg, svg *, option)")]
                .filter((each) => each.checkVisibility() && !each.matches(".scroll *, #study, #study-lines, .unseen"))
                .filter((each) => each.getBoundingClientRect().right > Math.min(window.innerWidth, document.getElementById("submit-dialog").getBoundingClientRect().right) + 1)
                .map((each) => each.outerHTML.slice(0, 100)));
            assert.deepEqual(wide, [], `${step}, ${width} px`);
            await page.screenshot({ path: `${process.env.BREACH_BROWSER_BUILD}/screenshots/form_${step.toLowerCase()}_${width}.png` });
        }
    }
    await page.setViewportSize({ width: 1400, height: 900 });
});

test("nothing failed inside the page", () => {
    assert.deepEqual(browser.complaints, []);
    assert.deepEqual(browser.foreign, []);
});
