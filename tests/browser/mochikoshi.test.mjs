// The whole case at a quarter of its resolution, asked for by one command and watched in the browser: stability,
// shaking and liquefaction, transfers, runout, report.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { canvas_facts, screenshot, until } from "./browser.mjs";
import { live_page, program } from "./service.mjs";

const study_file = path.join(process.env.BREACH_ROOT, "workflows/studies/mochikoshi_quarter.json");
const study = JSON.parse(readFileSync(study_file, "utf8"));
const patience = 900000; // [ms] for the FEM on a busy machine

let service;
let data;
let page;
let run;

const live = live_page("data-", { ready: (opened) => ({ service, page, folder: data } = opened) });

const breach = (...words) => execFileSync(program("breach"), ["--server", service.url, ...words], { encoding: "utf8" });
const answer_of = async (address) => (await fetch(service.url + address)).json();
const telemetry = async () => (await answer_of(`/v1/runs/${run}/telemetry?phase=fem_solver&from=0`)).lines;

test("one request starts everything", async () => {
    breach("submit", study_file);
    [{ id: run }] = (await answer_of("/v1/runs")).runs;
    await page.goto(`${service.url}/#/runs/${run}`);
    await page.waitForSelector("#run:not([hidden])");
    assert.equal(await page.textContent("#run-title"), study.title);
});

test("the page sees it to its end", async () => {
    await until("the end of the run", async () => /usable|questionable|failed|partial/.test(await page.textContent("#run-state")), patience);
    // On 5 m cells some of it may be questionable, which it then says.
    assert.match(await page.textContent("#run-state"), /usable|questionable/);
    await until("one marker per transfer time", async () =>
        (await page.locator("#runout-plot svg.plot > .marker.series-0").count()) >= study.transfer_times.length);
    await screenshot(page, "mochikoshi");
    assert.deepEqual(live.browser.complaints, []);
});

test("stability has the published factors of safety", async () => {
    const { tasks } = await answer_of(`/v1/runs/${run}`);
    const { stages } = tasks.find((task) => task.phase === "lem_tool").result;
    const reference = [1.8982, 1.8562, 0.9757, 0.5442, 0.5403, 0.5403]; // an independent code's on this section
    stages.forEach((stage, i) => assert.ok(Math.abs(stage.factor_of_safety / reference[i] - 1) < 5e-3,
                                           `${stage.factor_of_safety} for ${reference[i]}`));
});

test("the dam liquefies from the top, slides, and is not held by its hourglass stiffness", async () => {
    const lines = await telemetry();
    const last = lines.at(-1);
    const deepest = Math.max(...lines.map((line) => line.liquefaction_depth));
    console.log(`t = ${last.time} s: crest ${last.crest_displacement.toFixed(2)} m, liquefied to ${deepest.toFixed(1)} m, ` +
                `mean epsilon_q ${last.epsilon_q_avg.toFixed(3)}, ${last.failure_surfaces} failure surfaces`);
    assert.ok(deepest > 12, `liquefied to ${deepest} m`);
    assert.ok(last.crest_displacement > 1, `crest moved ${last.crest_displacement} m`);
});

test("every transfer keeps mass and momentum, every runout has a length and an energy budget", async () => {
    const { rows } = await answer_of(`/v1/runs/${run}/results`);
    assert.ok(rows.length >= study.transfer_times.length);
    for (const row of rows) {
        console.log(`t_T = ${row.transfer_time} s: runout ${row.runout?.toFixed(2)} m, numerical share ` +
                    `${row.numerical_share?.toFixed(3)}, ${row.cpu_seconds} s CPU`);
        assert.ok(["succeeded", "questionable"].includes(row.state), row.state);
        assert.ok(Number.isFinite(row.runout) && Number.isFinite(row.numerical_share));
        assert.ok(Math.abs(row.volume_ratio - 1) < 0.1, `volume ratio ${row.volume_ratio}`);
    }
});

test("liquefied soil is seen in the picture", async () => {
    await page.click("#runout-rows tr:last-child button");
    await until("soil", async () => (await canvas_facts(page)).share > 0.02);
    await screenshot(page, "mochikoshi_runout");
});

test("its report is read without a network: every figure, the motion that was applied, the paper's numbers", async () => {
    const folder = path.join(data, "exported");
    const report = path.join(data, "report.html");
    breach("export", run, folder);
    const tests = path.join(data, "element_tests");
    const soil = path.join(process.env.BREACH_ROOT, "workflows/element_tests/tailings.json");
    execFileSync(program("fem_solver"), ["element-test", soil, "--output", tests, "--progress", "none"]);
    execFileSync(program("report"), [folder, "--output", report, "--element-tests", tests]);
    await page.context().setOffline(true);
    await page.goto(`file://${report}`);
    const figures = await page.evaluate(() => [...document.querySelectorAll("figure")].map((figure) => {
        const { width, height } = figure.querySelector("svg").getBoundingClientRect();
        return { name: figure.id, seen: width > 300 && height > 100, marks: figure.querySelectorAll("svg path, svg circle, svg polyline").length };
    }));
    assert.ok(figures.length > 30, `${figures.length} figures`);
    assert.deepEqual(figures.filter(({ seen, marks }) => !seen || marks === 0), []);
    for (const name of ["safety_against_depth", "cyclic_strength_CRR", "undrained_stress_strain", "motion_acceleration", "liquefaction_depth", "runout_against_transfer_time"]) {
        assert.ok(figures.some((figure) => figure.name === name), name);
    }
    assert.match(await page.textContent("#comparison"), /critical depth/);
    assert.deepEqual(live.browser.foreign, []);
    await screenshot(page, "mochikoshi_report");
});
