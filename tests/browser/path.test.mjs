// A new run as a path: from nothing to a submitted dam without JSON, by the real service.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { until } from "./browser.mjs";
import { field_of, go_to_step } from "./form_page.mjs";
import { live_page } from "./service.mjs";

const read = (file) => readFileSync(new URL(`../../${file}`, import.meta.url), "utf8");
const drawing = read("services/import/example/dam.dxf");

let page;
const live = live_page("path-", { ready: ({ page: opened }) => {
    page = opened;
} });

const value = async () => JSON.parse(await page.inputValue("#study"));
const scene = async () => (await value()).scene;
const answer = async (path, options) => (await fetch(live.service.url + path, options)).json();
const open_dialog = async () => {
    await page.goto("about:blank");
    await page.goto(live.service.url);
    await page.click("nav [data-opens=submit]");
    await until("templates", () => page.isVisible("#template-choice button"));
};
const drop = (name, text) => page.evaluate(([file, content]) => {
    const data = new DataTransfer();
    data.items.add(new File([content], file));
    document.getElementById("submit-dialog").dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
}, [name, text]);
const faults = () => page.locator("#steps .fault-count:visible:not(.warn)").count();
const sound = (what) => until(what, async () => (await page.locator("#drawing-picture path.region").count()) > 1 && (await faults()) === 0);

test("the start page shows three studies with section, sentence and minutes; a click opens one in the form", async () => {
    await page.goto(live.service.url);
    const card = (name) => page.locator(`#starts [value=${name}]`);
    await until("three cards with their minutes", async () => (await page.locator("#starts button", { hasText: "minute" }).count()) === 3);
    assert.match(await card("upstream_dam").textContent(), /upstream raises on tailings\d+ to \d+ minutes$/);
    assert.ok((await card("static-lift").locator("path.before").count()) > 2, "the section of its own scene");
    await card("static-lift").click();
    await until("its study", async () => (await page.inputValue("#study")).includes('"static-lift"'));
    assert.equal(await page.textContent("#step-title"), "5. Check");
    await page.keyboard.press("Escape");
    await card("upstream_dam").click();
    await until("its options", () => page.isVisible("#options-fields"));
    assert.equal(await page.getAttribute("#template-choice [value=upstream_dam]", "aria-pressed"), "true");
    assert.equal(await page.locator("#template-choice .plot path.toe").count(), 4, "every template has its picture");
    await page.keyboard.press("Escape");
});

test("from nothing to a submitted dam of one's own with a clay layer, in at most 40 clicks and without JSON", async () => {
    await page.goto(live.service.url);
    let clicks = 0;
    const click = async (selector) => {
        clicks += 1;
        await page.click(selector);
    };
    const choose = async (selector, option) => {
        clicks += 2;
        await page.selectOption(selector, option);
    };
    const type = async (label, text) => {
        clicks += 1;
        await page.getByLabel(label, { exact: true }).filter({ visible: true }).fill(text);
    };
    await click("nav [data-opens=submit]");
    await click("#template-choice [value=upstream_dam]");
    await until("the dam", async () => (await page.inputValue("#study")) !== "");
    await type("height", "18");
    await type("raises", "3");
    await type("foundation depth", "5");
    await type("clay thickness", "2");
    assert.ok(await page.isHidden("#check"), "a step shows its own part only");
    await click("#step-next");
    await type("clay strength", "30");
    await until("the clay", async () => (await scene())?.materials?.clay?.law.c_kPa === 30);
    await type("density of clay", "1750");
    await type("c of embankment", "8");
    await click("#step-next");
    await type("beach length", "40");
    await click("#step-next");
    await click('#question label:has-text("liquefied at rest") input');
    await click("#step-next");
    await type("title", "A dam of mine on clay");
    await until("its cost", async () => /mpm_solver: .* CPU/.test(await page.textContent("#cost-lines")));
    await sound("nothing is wrong");
    assert.ok((await page.locator("#drawing-warnings li").count()) > 0, "coarse cells are warned of");
    assert.ok(await page.isHidden("#json"));
    await click("#submit");
    await until("the run", async () => (await page.textContent("#run-title")) === "A dam of mine on clay");
    console.log(`clicks from nothing to a submitted dam: ${clicks}`);
    assert.ok(clicks <= 40, `${clicks} clicks`);
    const { runs: [run] } = await answer("/v1/runs");
    await answer(`/v1/runs/${run.id}/cancel`, { method: "POST", headers: { "Content-Type": "application/json" }, body: "{}" });
    const { study } = await answer(`/v1/runs/${run.id}`);
    const { materials, section } = study.scene;
    assert.ok(section.regions.some(({ material }) => material === "clay"));
    assert.deepEqual([materials.clay.density, materials.clay.law.c_kPa, materials.embankment.law.c_kPa], [1750, 30, 8], "what was typed in the table stayed when the beach changed");
});

test("what a person entered stays when the template changes; what cannot stay is said", async () => {
    await open_dialog();
    await page.click("#template-choice [value=upstream_dam]");
    await sound("the dam");
    await (await field_of(page, "/scene/materials/foundation/density")).fill("1777");
    await (await field_of(page, "/scene/mpm/runout/toe")).fill("5");
    await go_to_step(page, "Section");
    await page.getByLabel("raises", { exact: true }).fill("2");
    await until("two raises", async () => !(await scene()).section.regions.some(({ name }) => name === "raise_3"));
    assert.equal((await scene()).materials.foundation.density, 1777);
    assert.deepEqual((await scene()).mpm.runout.toe, [5, 0]);
    const polygon = (await scene()).section.regions[0].polygon;
    await page.evaluate(([x, y]) => { // as if a vertex were moved by hand
        const box = document.getElementById("study");
        box.value = box.value.replace(`[${x}, ${y}]`, `[${x}, ${y - 1}]`);
        box.dispatchEvent(new Event("input"));
    }, polygon[0]);
    await page.getByLabel("foundation depth", { exact: true }).fill("6");
    await until("the loss is said", async () => /entered there is lost.*\/scene\/section\/regions\/foundation\/polygon/.test(await page.textContent("#options-note")));
});

test("a drawing dropped into an empty dialog leads to its soils; a drawing read again keeps them", async () => {
    await open_dialog();
    await drop("dam.dxf", drawing);
    await until("step 2", async () => (await page.textContent("#steps [aria-current]")).startsWith("2"));
    await until("a soil for each layer", async () => Object.keys((await scene()).materials).length === 4);
    await until("what is missing is said", async () => (await page.locator(".soils [aria-invalid]").count()) === 12);
    for (const [name, preset] of [["FOUNDATION", "Dam fill of tailings, drained"], ["RAISES", "Dam fill of tailings, drained"], ["STARTER", "Dam fill of tailings, drained"], ["TAILINGS", "Tailings, not liquefied"]]) {
        const option = page.getByLabel(`preset of ${name}`).locator("option", { hasText: preset });
        assert.match(await option.textContent(), /\(Sordo, Rathje & Kumar \(2024\)/, "a preset names its source");
        await page.getByLabel(`preset of ${name}`).selectOption(await option.getAttribute("value"));
        await until(preset, async () => (await scene()).materials[name].notes?.[0].startsWith(preset));
    }
    await sound("whole soils");
    await page.getByLabel("density of TAILINGS").fill("19");
    await until("the slip of the unit is said", async () => /1,?9\d\d kg\/m3/.test(await page.locator(".soils .field-faults").allTextContents().then((all) => all.join())));
    await page.getByLabel("density of TAILINGS").fill("3300");
    assert.match(await page.locator(".soils .doubt:visible").textContent(), /mostly 1000 to 3200 kg\/m3/);
    await page.getByLabel("density of TAILINGS").fill("1880");
    const [first] = (await scene()).lem.search.entry;
    await drop("again.dxf", drawing.replaceAll("\r\n", "\n"));
    await until("read again", async () => (await page.textContent("#options-title")).includes("again.dxf") && (await value()).name === "again");
    assert.equal((await scene()).materials.TAILINGS.density, 1880);
    assert.equal((await scene()).lem.search.entry[0], first);
    await go_to_step(page, "Question");
    assert.ok(await page.locator('#question label:has-text("Does it stand?") input').isChecked());
    await page.click('#question label:has-text("earthquake") input');
    await until("what can liquefy is asked for", async () => /no region is cut in layers/.test(await page.textContent("#drawing-faults")));
    await go_to_step(page, "Section");
    await page.getByLabel("layers", { exact: true }).fill("TAILINGS=5,10");
    await until("the FEM", async () => (await scene()).fem?.damping.ratio === 0.005);
    assert.deepEqual((await value()).transfer_times, [3.2, 4.8, 6.4, 8]);
    assert.match((await scene()).fem.motion.file, /^file:sha256/);
    assert.deepEqual([(await scene()).materials.TAILINGS.law.type, (await scene()).materials.TAILINGS_runout.density], ["pm4sand", 1880]);
    await sound("the shaken section");
    await go_to_step(page, "Question");
    assert.ok(await page.locator('#question label:has-text("earthquake") input').isChecked());
    await page.click('#question label:has-text("liquefied at rest") input');
    await page.getByLabel("liquefied", { exact: true }).fill("TAILINGS=0.08, CPTu 2024");
    await until("no FEM", async () => (await scene()).fem === undefined);
    assert.deepEqual(Object.keys((await scene()).materials).filter((name) => !/_wet$/.test(name)).sort(), ["FOUNDATION", "RAISES", "STARTER", "TAILINGS", "TAILINGS_liquefied"]);
    assert.equal((await scene()).materials.TAILINGS.law.type, "mohr_coulomb");
    await sound("the section that liquefies");
});

test("a study file whose scene is a name asks for that file", async () => {
    await open_dialog();
    const slope = JSON.parse(read("workflows/studies/slope_sweep.json"));
    await drop("slope_sweep.json", JSON.stringify(slope));
    await until("the question", () => page.isVisible("#scene-wanted"));
    assert.match(await page.textContent("#scene-wanted"), new RegExp(`names its scene: ${slope.scene.replaceAll(".", "\\.")}`));
    assert.match(await page.textContent("#steps [aria-current]"), /^1/);
    await drop("slope.json", read("workflows/scenes/slope.json"));
    await until("the check", async () => (await page.textContent("#steps [aria-current]")).startsWith("5"));
    assert.ok(await page.isHidden("#scene-wanted"));
    assert.equal((await value()).scene.name, "slope");
    assert.equal((await value()).name, slope.name);
});

test("a question puts in the parts that it needs and takes out the others", async () => {
    await open_dialog();
    await page.click("#template-choice [value=upstream_dam]");
    await sound("the dam");
    await go_to_step(page, "Question");
    const ask = (words) => page.locator(`#question label:has-text("${words}") input`).click();
    const whole = await page.inputValue("#study");
    await ask("Does it stand?");
    assert.equal((await scene()).mpm, undefined);
    assert.ok(!JSON.stringify((await value()).variants).includes("/mpm/"));
    await sound("a stability study");
    await ask("liquefied at rest");
    await until("the runout again", async () => JSON.stringify(await value()) === JSON.stringify(JSON.parse(whole)));
    await ask("earthquake");
    await until("an earthquake", async () => Boolean((await scene()).fem?.motion && (await value()).transfer_times));
    await ask("liquefied at rest");
    await until("none", async () => (await scene()).fem === undefined && (await value()).transfer_times === undefined);
    await ask("How certain");
    const { uncertainty, variants } = await value();
    assert.equal(variants, undefined);
    assert.ok(uncertainty.parameters[0].factor_on.includes("/materials/tailings_1/law/c_kPa"));
    await sound("a study over distributions");
    await ask("How certain");
    await until("the variants", async () => (await value()).variants.length === 2);
});

test("every preset is a soil of a shipped scene, or one that the service accepts", async () => {
    const { $defs: { material } } = await answer("/v1/schema/scene");
    const { scene: slope } = await answer("/v1/examples/flow-slope");
    assert.ok(material["x-presets"].length > 5);
    for (const { title, example, material: name, source, soil } of material["x-presets"]) {
        if (soil) {
            const study = { format: "breachline-study/1", name: "preset", scene: { ...slope, materials: { ...slope.materials, tailings: soil } } };
            const json = { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(study) };
            const cost = await answer("/v1/cost", json);
            assert.ok(cost.lines, `${title}: ${JSON.stringify(cost)}`);
        } else {
            assert.ok((await answer(`/v1/examples/${example}`)).scene?.materials[name]?.density > 0, title);
        }
        assert.match(source, /\(\d{4}\)/, title);
    }
});

test("nothing failed inside the page", () => {
    assert.deepEqual(live.browser.complaints, []);
    assert.deepEqual(live.browser.foreign, []);
});
