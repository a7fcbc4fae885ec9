// The view of a study over distributions, against a stand-in server whose samples come from a model that is known (samples.mjs).
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { open_browser, open_run, screenshot, until } from "./browser.mjs";
import { FakeApi, study } from "./fake_api.mjs";
import { uncertain_study } from "./samples.mjs";

const api = new FakeApi({ pace: 6, points: 500 });
let url;
let page;
let browser;

before(async () => {
    url = await api.open();
    browser = await open_browser();
    page = browser.page;
});

after(async () => {
    await browser.close();
    await api.close();
});

const text_of = (selector) => page.textContent(selector);

async function open_samples(count, settings = {}, more = {}) {
    const run = api.add_run({ ...uncertain_study(study, count), ...more }, { began: Date.now() - 60000, ...settings });
    await open_run(page, url, run.id);
    await page.waitForSelector("#uncertainty:not([hidden]) #uncertainty-samples tbody tr");
    return run;
}

test("samples without a transfer have ended, and are counted separately from those that failed", async () => {
    await open_samples(64, {}, { stood: ["s0010", "s0011"] });
    const doubts = await text_of("#uncertainty-doubts");
    assert.match(doubts, /2 samples of 64 left no result/);
    assert.match(doubts, /No transfer from 2 samples of 64/);
    assert.match(await text_of("#uncertainty-left-out-title"), /4 samples/);
});

test("the number of samples, and its limits, are shown above the numbers", async () => {
    const run = await open_samples(64);
    assert.match(await text_of("#uncertainty-counts"), /^60 of 64 samples ended with a result/);
    const doubts = await text_of("#uncertainty-doubts");
    assert.match(doubts, /2 samples of 64 left no result and are in no number here/);
    assert.match(await text_of("#uncertainty-percentiles-caption"), /^60 of 64 samples; mean ≥ /, "one of them is a lower bound");
    assert.equal(await text_of("#uncertainty-left-out-title"), "Left out: 2 samples");
    await page.click("#uncertainty-left-out-title");
    assert.match(await text_of("#uncertainty-left-out-list"), /s0005 failed: exit 70: a point left the grid.*s0035/s);
    assert.ok(await page.isHidden("#runouts"), "sixty variants side by side are no figure");
    await page.click("#uncertainty-left-out-list button");
    await until("the task of the one that failed", async () => /mpm_solver.*s0005/.test(await text_of("#task-title")));
    assert.equal(run.study.variants.length, 64);
    assert.deepEqual(browser.complaints, []);
});

test("percentiles are those of the samples; one above soil that still moved is a lower bound", async () => {
    const run = await open_samples(64);
    const told = run.answer.quantities.runout_beyond_toe.percentiles;
    const cells = await page.locator("#uncertainty-percentile-rows tr").allInnerTexts();
    assert.deepEqual(cells.map((text) => text.split("\t")[0]), ["p5", "p10", "p50", "p90", "p95"]);
    cells.forEach((text, i) => assert.equal(text.split("\t")[1], `${Number(told[i].value.toPrecision(4))} m`));
    const many = await open_samples(300);
    const least = Math.min(...many.answer.rows.filter(({ state }) => state === "questionable").map(({ results }) => results.runout_beyond_toe));
    const marked = await page.locator("#uncertainty-percentile-rows tr td:nth-child(2)").allInnerTexts();
    many.answer.quantities.runout_beyond_toe.percentiles.forEach(({ value }, i) => assert.equal(marked[i].startsWith("≥"), value >= least, marked[i]));
    assert.equal(await page.locator("#uncertainty-exceedance .band.lower-bound").count(), 1);
});

test("the curve falls in steps from the share above the least sample, with its band", async () => {
    const run = await open_samples(64);
    assert.equal(await page.locator("#uncertainty-exceedance svg.plot > path.curve").count(), 1);
    assert.equal(await page.locator("#uncertainty-exceedance svg.plot > path.error-band").count(), 1);
    await page.focus("#uncertainty-exceedance svg.plot");
    await page.keyboard.press("End");
    const last = run.answer.quantities.runout_beyond_toe.exceedance.at(-1);
    assert.match(await text_of("#uncertainty-exceedance .readout"), new RegExp(`^more than = ${Number(last.value.toPrecision(4))} m`));
    const path = await page.getAttribute("#uncertainty-exceedance svg.plot > path.curve", "d");
    const points = path.slice(1).split("L").map((pair) => pair.split(",").map(Number));
    assert.ok(points.slice(1).every(([x, y], i) => x === points[i][0] || y === points[i][1]), "level or upright");
    assert.ok(points.slice(1).every(([, y], i) => y >= points[i][1]), "never rises");
});

test("a tornado is shown or says why not; what decides is in order", async () => {
    await open_samples(64);
    const labels = await page.locator("#uncertainty-tornado svg.plot > text.label").evaluateAll((all) => all.map((each) => each.firstChild.data));
    assert.deepEqual(labels, ["residual strength", "viscosity", "motion", "99 % of what passed the toe [m]"]);
    assert.match(await text_of("#uncertainty-tornado-note"), /Q² = 0\.93 by cross-validation/);
    assert.match(await text_of("#uncertainty-importance-rows tr"), /^residual strength-0\.9/);
    await page.selectOption("#uncertainty-quantity", "runout");
    assert.ok(await page.isHidden("#uncertainty-tornado"));
    assert.match(await text_of("#uncertainty-tornado-note"), /^No tornado: Q2 is 0\.4; 0\.7 is needed/);
});

test("a click on a sample leads to its task, also where many have one value", async () => {
    await open_samples(64);
    for (const [parameter, sample] of [["residual strength", "s0007"], ["motion", "s0012"], ["lattice", "s0022"]]) {
        await page.selectOption("#uncertainty-parameter", parameter);
        const mark = page.locator("#uncertainty-scatter svg.plot > .marker").filter({ hasText: sample });
        await mark.scrollIntoViewIfNeeded();
        const box = await mark.boundingBox();
        await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
        assert.match(await text_of("#uncertainty-scatter .readout"), new RegExp(sample), parameter);
        await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
        await until(`the task of ${sample}`, async () => (await text_of("#task-title")).includes(sample));
        await page.click("#task-close");
        await page.locator("#uncertainty").scrollIntoViewIfNeeded();
    }
    await page.selectOption("#uncertainty-parameter", "viscosity");
    const ticks = await page.locator("#uncertainty-scatter .tick-x, #uncertainty-scatter svg.plot > text").allTextContents();
    for (const power of ["100", "1000"]) assert.ok(ticks.includes(power), "a logarithmic axis");
    await page.click("#uncertainty-samples tbody tr:nth-child(2) .link");
    await until("the task behind a row", async () => (await text_of("#task-title")).includes("s0002"));
});

test("what stands along x says on how many samples it rests", async () => {
    await open_samples(64);
    assert.match(await text_of("#uncertainty-along-note"), /^60 of 64 samples\. Where the flow of a sample never came it is 0 there\. 1 still moved/);
    await page.selectOption("#uncertainty-column", "arrival");
    assert.match(await text_of("#uncertainty-along-note"), /a percentile ends where too few came/);
    assert.deepEqual(await page.locator("#uncertainty-envelope .legend li").allTextContents(), [" p50", " p50, some never came", " p10 to p90"]);
    await (await page.$("#uncertainty")).scrollIntoViewIfNeeded();
    await screenshot(page, "uncertainty");
});

test("too few samples have no percentiles, and the page says so", async () => {
    await open_samples(5);
    assert.match(await text_of("#uncertainty-refused"), /3 samples are not enough for the 50th percentile/);
    assert.ok(await page.isHidden("#uncertainty-percentiles"));
    assert.match(await text_of("#uncertainty-importance-note"), /^3 of 5 samples\. Pale/);
    assert.match(await text_of("#uncertainty-tornado-note"), /^No tornado/);
    await open_samples(40);
    assert.match(await page.innerText("#uncertainty-percentile-rows tr"), /p5\s+–\s+36 samples are not enough: 59 are needed/);
});

test("a search for one value shows its steps, what was asked and what was found, and no distribution", async () => {
    const run = api.add_run(uncertain_study(study, 9), { began: Date.now() - 60000 });
    const step = (value, results, moving) => ({ value, results, lower_bounds: moving, result: results.reduce((sum, each) => sum + each) / results.length, state: "done" });
    run.answer = { ...run.uncertainty(), quantities: {}, sentences: ["A residual strength of at least 0.484 gives a runout_beyond_toe of 215 m."],
                   inverse: { quantity: "runout_beyond_toe", unit: "m", target: 215, vary: "residual strength", state: "found", value: 0.484, bound: "at_least", low: 0.465, high: 0.504, reason: "",
                              noise: 3, steps: [step(0.4, [227, 237, 234], 3), step(0.475, [218, 213, 219], 1), step(0.49, [212, 214, 211], 0), step(2.5, [9, 10, 11], 0)] } };
    await open_run(page, url, run.id);
    await page.waitForSelector("#uncertainty-search:not([hidden]) path.marker");
    assert.match(await text_of("#uncertainty-found"), /at least 0\.484 gives/);
    assert.ok(await page.isHidden("#uncertainty-figures"));
    assert.ok(await page.isHidden("#uncertainty-quantity"));
    const figure = await text_of("#uncertainty-steps");
    assert.match(figure, /asked 215/);
    assert.match(figure, /≥ 0\.484/);
    assert.match(figure, /90 % by the scatter of lattices alone/);
    assert.match(figure, /still moving|lower bound|at least/);
    const box = async (selector) => (await page.locator(`#uncertainty-steps svg.plot ${selector}`).first().boundingBox());
    const [found, band] = [await box("path.event"), await box("rect.band")];
    assert.ok(band.x < found.x && found.x < band.x + band.width, "the value stands within its interval");
    await screenshot(page, "back_analysis");
    assert.deepEqual(browser.complaints, []);
});

test("a run over nothing but transfer times has no such view", async () => {
    const run = api.add_run(study, { began: Date.now() - 60000 });
    await open_run(page, url, run.id);
    assert.ok(await page.isVisible("#runouts"));
    assert.ok(await page.isHidden("#uncertainty"));
});

test("a thousand samples: list and figures, measured", async () => {
    await open_samples(1000);
    assert.match(await text_of("#uncertainty-counts"), /^964 of 1000 samples ended/);
    assert.match(await text_of("#uncertainty-samples [role=status]"), /^Rows 1 to 50 of 1000/);
    const times = await page.evaluate(async () => {
        const { Uncertainty } = await import("/static/uncertainty.js");
        const { read_run, read_results } = await import("/static/api.js");
        const id = location.hash.split("/").at(-1);
        const [run, { rows }] = [await read_run(id), await read_results(id)];
        const view = new Uncertainty({ open_task() {}, ask() {} });
        await view.show(run, rows);
        const laid_out = (work) => {
            const begin = performance.now();
            work();
            document.body.getBoundingClientRect(); // layout is part of it
            return performance.now() - begin;
        };
        const median = (work) => Array.from({ length: 7 }, () => laid_out(work)).sort((a, b) => a - b)[3];
        const change = (id, value) => () => {
            const select = document.getElementById(id);
            select.value = value;
            select.dispatchEvent(new Event("change"));
        };
        return { all: median(() => view.draw()), list: median(() => view.draw_samples(view.answer.quantities[view.quantity])),
                 scatter: median(() => view.draw_scatter(view.answer.quantities[view.quantity])),
                 exceedance: median(() => view.draw_exceedance(view.answer.quantities[view.quantity])), run: run.tasks.length };
    });
    console.log(`1,000 samples, median of 7 [ms]: ${Object.entries(times).map(([what, ms]) => `${what} ${ms.toFixed(0)}`).join(", ")}`);
});
