// No rule of axe-core is broken by any view of the page, wide in light colours and narrow in dark ones.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import path from "node:path";
import { build_folder, open_browser, until } from "./browser.mjs";
import { drawn, FakeApi, some_flagged, study, two_variants } from "./fake_api.mjs";
import { go_to_step, write_json } from "./form_page.mjs";
import { uncertain_study } from "./samples.mjs";

const axe = readFileSync(path.join(build_folder, "node_modules/axe-core/axe.min.js"), "utf8");
const small_study = readFileSync(new URL("small_study.json", import.meta.url), "utf8");
const api = new FakeApi({ pace: 1 });
let [url, page, browser] = [];

before(async () => {
    url = await api.open();
    browser = await open_browser();
    page = browser.page;
});
after(async () => {
    await browser.close();
    await api.close();
});

const ended = () => ({ began: Date.now() - 20000, pace: 1 });

/// What axe-core finds, wide in light colours and narrow in dark ones.
async function violations_of(what) {
    const found = [];
    for (const [width, theme] of [[1400, "light"], [390, "dark"]]) {
        await page.setViewportSize({ width, height: 900 });
        await page.evaluate((wanted) => { document.documentElement.dataset.theme = wanted; }, theme);
        if (!(await page.evaluate(() => "axe" in window))) await page.evaluate(axe);
        const { violations } = await page.evaluate(() => window.axe.run({ resultTypes: ["violations"] }));
        found.push(...violations.map(({ id, nodes }) => `${what}, ${width} px, ${theme}, ${id}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 160)).join(" | ")}`));
    }
    return found;
}

async function open_run(run) {
    await page.goto(`${url}/#/runs/${run.id}`);
    await until("the run", async () => (await page.textContent("#run-title")) === (run.study.title ?? run.study.name) && (await page.isVisible("#tasks:not(.coming)")));
}

test("runs: with flags, with draws, with samples, with triggers", async () => {
    const found = [];
    await open_run(api.add_run({ ...study, name: "flagged", title: "Flagged" }, { ...ended(), flagged: some_flagged, entangles: 2.1 }));
    found.push(...await violations_of("flagged"));
    await page.click('#task-rows tr:has-text("mpm_solver") button');
    found.push(...await violations_of("a task"));
    await open_run(api.add_run(drawn, ended()));
    found.push(...await violations_of("draws"));
    await open_run(api.add_run({ ...uncertain_study(study, 64), title: "Samples" }, ended()));
    found.push(...await violations_of("samples"));
    await open_run(api.add_run({ ...two_variants, title: "Triggers" }, ended()));
    found.push(...await violations_of("triggers"));
    assert.deepEqual(found, []);
});

test("start, database, comparison, differences", async () => {
    const found = [];
    const [one, other] = api.runs.map(({ id }) => id);
    for (const [address, part] of [["#/", "#welcome"], ["#/database/tasks", "#database-table td"], ["#/database/results", "#database-table td"],
                                   [`#/compare/${one}-task-3/${other}-task-3`, "#compare-run-0"], [`#/differences/${one}/${other}`, "#differences-results td"]]) {
        await page.goto(`${url}/${address}`);
        await page.locator(part).first().waitFor();
        found.push(...await violations_of(address));
    }
    assert.deepEqual(found, []);
});

test("a new run, empty and in each of its steps", async () => {
    const found = [];
    await page.goto(url);
    await page.click("nav [data-opens=submit]");
    await until("the form's beginning", async () => (await page.locator("#form button").count()) === 1);
    found.push(...await violations_of("empty"));
    await write_json(page, small_study.replace("1800", "-1800"));
    await until("a fault", async () => (await page.locator("#steps .fault-count:visible").count()) === 1);
    for (const step of ["Section", "Soils", "Water", "Question", "Check"]) {
        await go_to_step(page, step);
        await page.waitForTimeout(300);
        found.push(...await violations_of(step));
    }
    assert.deepEqual(found, []);
});
