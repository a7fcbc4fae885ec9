// A person's way through the page with nothing made up: the real orchestrator, the real phases, a small column. The
// job is submitted in the browser, seen finishing, and its curve and particles are looked at.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { canvas_facts, screenshot, until } from "./browser.mjs";
import { go_to_step, write_json } from "./form_page.mjs";
import { live_page, program } from "./service.mjs";

const study_file = new URL("small_study.json", import.meta.url);
const study = JSON.parse(readFileSync(study_file, "utf8"));

let url;
let page;

const live = live_page("data-", { ready: ({ service, page: opened }) => {
    page = opened;
    url = service.url;
} });

const text_of = (selector) => page.textContent(selector);
const markers = () => page.locator("#runout-plot svg.plot > .marker.series-0").count();
const answer_of = async (address) => (await fetch(url + address)).json();

/// The run's report, opened.
async function report_of(run, name) {
    const folder = path.join(live.folder, `exported-${name}`);
    const report = path.join(live.folder, `${name}.html`);
    execFileSync(program("breach"), ["--server", url, "export", run, folder], { encoding: "utf8" });
    execFileSync(program("report"), [folder, "--output", report]);
    const paper = await page.context().newPage();
    await paper.goto(`file://${report}`);
    return paper;
}

/// Nothing of a page is cut off on A4 and Letter, all upright: no element is wider than what the margins of 12 mm leave (at 96 px to the inch),
/// no text leaves its figure, every cell and sentence is in the PDF's text, and the first page is the one to sign.
async function printed_whole(paper, name) {
    await paper.emulateMedia({ media: "print" });
    const words = await paper.$$eval("h1, h2, td, th, .front li, figcaption", (all) => all.map((each) => each.innerText));
    const bare = (text) => text.replaceAll(/\s/g, "");
    for (const [format, width] of [["A4", 703], ["Letter", 725]]) {
        await paper.setViewportSize({ width, height: 900 });
        const cut = await paper.evaluate(() => {
            const room = document.body.getBoundingClientRect().right + 0.5;
            const named = (each) => `${each.tagName} ${each.id || each.closest("[id]")?.id} ${each.textContent.slice(0, 40)}`;
            const wide = [...document.querySelectorAll("body *:not(svg *)")].filter((each) => each.getBoundingClientRect().right > room);
            const out = [...document.querySelectorAll("figure svg text")].filter((each) => {
                const [text, frame] = [each, each.ownerSVGElement].map((one) => one.getBoundingClientRect());
                return text.left < frame.left - 1 || text.right > frame.right + 1 || text.top < frame.top - 1 || text.bottom > frame.bottom + 1;
            });
            return [...wide, ...out].map(named);
        });
        assert.deepEqual(cut, [], `${name}, ${format}`);
        const file = path.join(live.folder, `${name}-${format}.pdf`);
        const pdf = (await paper.pdf({ path: file, format, preferCSSPageSize: true })).toString("latin1");
        for (const [, wide, high] of pdf.matchAll(/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]/g)) assert.ok(Number(wide) < Number(high), "upright");
        const text = bare(execFileSync("pdftotext", ["-raw", file, "-"], { encoding: "utf8" }));
        assert.deepEqual(words.filter((each) => !text.includes(bare(each))), [], `${name}, ${format}: all of it is in the PDF`);
        const first = bare(execFileSync("pdftotext", ["-raw", "-l", "1", file, "-"], { encoding: "utf8" }));
        for (const part of ["Question.", "What comes out", "Verdict of the checks", "Limits", "checked by"]) {
            assert.ok(first.includes(bare(part)), `${name}, ${format}: the first page has "${part}"`);
        }
    }
    numbers_pages(paper.url().replace("file://", ""));
}

/// In a PDF by WeasyPrint each chapter begins on the page that the contents name.
function numbers_pages(report) {
    const pdf = report.replace(".html", "-numbered.pdf");
    execFileSync("weasyprint", ["--quiet", report, pdf]);
    const pages = execFileSync("pdftotext", ["-raw", pdf, "-"], { encoding: "utf8" }).split("\f");
    const begins = pages.flatMap((text, at) => [...text.matchAll(/^\d+ (.+)$/gm)].map(([, title]) => `${title}, page ${at + 1}`));
    const named = [...pages.join("\n").matchAll(/^.+, page \d+$/gm)].map(([line]) => line);
    assert.ok(named.filter((each) => begins.includes(each)).length >= 4, `${report}: ${named} for ${begins}`);
}

test("a study with faults is refused with the places at fault", async () => {
    await page.goto(url);
    await page.click("nav [data-opens=submit]");
    const broken = structuredClone(study);
    broken.scene.materials.sand.density = -1800;
    broken.scene.materials.sand.law.nu = 0.5;
    broken.scene.mpm.cel_size = 2;
    await write_json(page, JSON.stringify(broken, null, 4));
    await page.click("#submit");
    await page.waitForSelector("#fault-list li");
    const pointers = await page.locator("#fault-list code").allTextContents();
    for (const place of ["/materials/sand/density", "/materials/sand/law/nu", "/mpm/cel_size"]) {
        assert.ok(pointers.some((pointer) => pointer.endsWith(place)), `${place} is in ${pointers}`);
    }
    await page.click(`#fault-list button:has-text("/density")`);
    assert.equal(await page.evaluate(() => getSelection().toString()), "-1800");
    await page.keyboard.press("Escape");
    assert.deepEqual((await answer_of("/v1/runs")).runs, []);
});

test("the section is drawn while one types, with what is wrong at its place", async () => {
    const region = () => page.locator("#drawing-picture path.region").count();
    const type = (document) => write_json(page, typeof document === "string" ? document : JSON.stringify(document, null, 4));
    await page.click("nav [data-opens=submit]");
    await type("");
    await until("what was typed before is gone", () => page.isHidden("#drawing"));
    await type(study);
    await until("the section", async () => (await region()) === study.scene.section.regions.length);
    assert.equal(await page.locator("#drawing-faults li").count(), 0);
    assert.match(await text_of("#drawing-picture"), /mpm_solver: about .* CPU/);
    await screenshot(page, "live_drawing");

    const wrong = structuredClone(study);
    wrong.scene.mpm.runout.toe = [1000, 0];
    await type(wrong);
    await until("a red mark", async () => (await page.locator("#drawing-picture g.fault circle").count()) === 1);
    assert.deepEqual(await page.locator("#drawing-faults code").allTextContents(), ["/scene/mpm/runout/toe"]);
    await page.click("#drawing-picture g.fault circle + text");
    assert.match(await page.evaluate(() => getSelection().toString()), /1000/);
    await screenshot(page, "live_drawing_fault");

    await type(JSON.stringify(study).slice(0, -1));
    await until("the reason", async () => /not JSON yet.*last drawing/.test(await text_of("#drawing-note")));
    assert.equal(await region(), study.scene.section.regions.length);
    assert.ok(await page.locator("#drawing-picture.stale").count(), "the last drawing is pale");
    await type({ ...study, scene: { format: "breachline-scene/1", name: "empty" } });
    await until("the server's faults", async () => (await page.locator("#drawing-faults li").count()) > 1);
    assert.ok(await page.locator("#drawing-picture.stale").count());
    await type(study);
    await until("fresh again", async () => (await page.locator("#drawing-picture.stale").count()) === 0);
    await type("");
    await until("nothing", () => page.isHidden("#drawing"));
    await page.keyboard.press("Escape");
});

test("the plan of a scene is shown before anything runs", async () => {
    await page.click("nav [data-opens=submit]");
    await write_json(page, JSON.stringify(study, null, 4));
    await go_to_step(page, "Check");
    await page.click("#show-plan");
    await until("a plan per phase", async () => (await page.locator("#plan table").count()) >= 3);
    await screenshot(page, "real_plan");
    await page.keyboard.press("Escape");
    assert.deepEqual((await answer_of("/v1/runs")).runs, []);
});

test("a job submitted in the page runs to its end, and the page shows it without being asked", async () => {
    await page.click("nav [data-opens=submit]");
    await page.setInputFiles("#study-file", study_file.pathname);
    await until("the check", async () => (await text_of("#steps [aria-current]")).startsWith("5"));
    assert.equal(JSON.parse(await page.inputValue("#study")).name, study.name);
    await page.click("#submit");
    await page.waitForSelector("#run:not([hidden])");
    assert.equal(await text_of("#run-title"), study.title);
    await until("the end of the run", async () => /usable|questionable/.test(await text_of("#run-state")), 120000);
    await until("one marker per transfer time", async () => (await markers()) === study.transfer_times.length);
    assert.equal(await page.locator("#task-rows tr").count(), 1 + 2 * study.transfer_times.length);
});

test("the table has the API's numbers", async () => {
    const [run] = (await answer_of("/v1/runs")).runs;
    const { rows } = await answer_of(`/v1/runs/${run.id}/results`);
    assert.deepEqual(rows.map((row) => row.transfer_time), study.transfer_times);
    for (const row of rows) {
        assert.ok(row.runout > 3, `the column runs out: ${row.runout} m`);
        const cells = await page.locator(`#runout-rows tr[data-key="${row.transfer_time}/"] td.number`).allTextContents();
        assert.equal(Number(cells[0].replace("≥ ", "")), Number(row.runout.toPrecision(4)));
        console.log(`t_T = ${row.transfer_time} s: runout ${row.runout.toFixed(3)} m, ${row.cpu_seconds} s CPU`);
    }
    const csv = await (await fetch(url + (await page.getAttribute("#runout-csv", "href")))).text();
    assert.equal(csv.trim().split("\n").length, 1 + rows.length);
});

test("particles of each transfer time are drawn and move", async () => {
    for (const transfer_time of study.transfer_times) {
        await page.click(`#runout-rows tr[data-key="${transfer_time}/"] button`);
        await until(`soil from t_T = ${transfer_time} s`, async () =>
            (await page.$eval("#view-source", (s) => s.selectedOptions[0].textContent)) === `MPM from t_T = ${transfer_time} s` &&
            (await canvas_facts(page)).share > 0.02);
    }
    await until("the last snapshot", async () => /\((\d+) of \1\)/.test(await text_of("#view-now")));
    const end = await canvas_facts(page);
    assert.ok(end.colours > 10, `${end.colours} colours`);
    await page.focus("#view-time");
    await page.keyboard.press("Home");
    await until("another picture", async () => (await canvas_facts(page)).sum !== end.sum);
    const first_time = parseFloat((await text_of("#view-now")).match(/t = ([\d.]+) s/)[1]);
    await page.keyboard.press("End");
    await until("the end again", async () => (await canvas_facts(page)).sum === end.sum);
    const last_time = parseFloat((await text_of("#view-now")).match(/t = ([\d.]+) s/)[1]);
    assert.ok(last_time > first_time, `snapshots are in order of time: ${first_time} s to ${last_time} s`);
});

test("the FEM's mesh and telemetry are drawn", async () => {
    await page.selectOption("#view-source", { label: "FEM mesh" });
    await until("50 elements", async () => (await text_of("#view-count")) === "50 elements");
    await until("colours", async () => (await canvas_facts(page)).share > 0.02);
    const titles = await page.locator("#telemetry-plots figcaption").allTextContents();
    for (const title of ["Crest displacement", "Kinetic energy", "Jacobian ratio, averages", "Deviatoric strain, average"]) {
        assert.ok(titles.includes(title), `${title} is in ${titles}`);
    }
    await page.selectOption("#telemetry-source", { index: 1 });
    await until("the front's curve", async () =>
        (await page.locator("#telemetry-plots figcaption").allTextContents()).includes("Front"));
    await page.selectOption("#telemetry-source", { index: 0 });
});

test("a task's log and files are there, and a file is what its hash says", async () => {
    await page.click("#task-rows tr:first-child button");
    await until("the log", async () => /fem_solver/.test(await text_of("#log")));
    const hashes = await page.locator("#task-artifacts code").allTextContents();
    assert.ok(hashes.length >= 2);
    const matches = await page.evaluate(async (sha256) => {
        const body = await (await fetch(`/v1/artifacts/${sha256}`)).arrayBuffer();
        const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", body));
        return [...digest].map((byte) => byte.toString(16).padStart(2, "0")).join("") === sha256;
    }, hashes[0]);
    assert.ok(matches);
});

test("a number is traced to its files, and the files are what they are said to be", async () => {
    const [run] = (await answer_of("/v1/runs")).runs;
    const [row] = (await answer_of(`/v1/runs/${run.id}/results`)).rows;
    await page.click(`#runout-rows tr[data-key="${row.transfer_time}/"] [data-column="runout"]`);
    await page.waitForSelector("#provenance[open] .step:nth-of-type(3)");
    assert.match(await text_of("#provenance-where"), new RegExp(`Exactly ${row.runout}: .*${row.mpm_task}`));
    const transfer = await answer_of(`/v1/tasks/${row.transfer_task}`);
    const points = transfer.artifacts.find((file) => file.name === "particles.vtkhdf");
    const mpm = page.locator("#provenance .step").first();
    assert.ok((await mpm.locator("li code").allTextContents()).includes(points.sha256), "the MPM's input is the transfer's output");
    await mpm.locator("summary", { hasText: "files with their hashes" }).click();
    const file = await mpm.locator('a[download="result.json"]').getAttribute("href");
    assert.equal((await answer_of(file)).runout, row.runout);
    await page.keyboard.press("Escape");
    assert.equal(await page.locator("#cost-share svg.plot > .marker").count(), study.transfer_times.length);
});

test("the database has the run's rows", async () => {
    await page.click('a[href="#/database"]');
    await until("the run", async () => /browser-column/.test(await text_of("#database-table tbody")));
    await page.click("[data-table=tasks]");
    await until("its tasks", async () => (await page.locator("#database-table tbody tr").count()) === 1 + 2 * study.transfer_times.length);
    await page.click("[data-table=events]");
    await until("events", async () => (await page.locator("#database-table tbody tr").count()) > 20);
    await page.click("[data-table=transfers]");
    await until("its transfers", async () => (await page.locator("#database-table tbody tr").count()) === study.transfer_times.length);
    assert.match(await text_of("#database-table tbody tr:first-child"), /at_time/);
    await page.click("[data-table=workers]");
    await until("nothing runs", async () => /^Local: 0 of \d+ cores taken; 0 tasks ready; 0 wait for others\.$/.test(await text_of("#database-slots")));
    assert.match(await text_of("#database-table p"), /No rows/);
    await page.goBack();
    await page.click("#run-list a");
});

test("the FEM's snapshot has displacements and vertical stresses, drawn as contours and along a cut", async () => {
    const fem = await page.$eval("#view-source", (select) => [...select.options].find((each) => each.textContent === "FEM mesh").value);
    const { frames } = await answer_of(`/v1/tasks/${fem}/frames`);
    const address = `/v1/tasks/${fem}/frames/${frames.at(-1).name}/points`;
    const bytes = await (await fetch(`${url}${address}?fields=u_x,u_y,displacement,sigma_v`)).arrayBuffer();
    const snapshot = await page.evaluate(async (numbers) => {
        const { decode_points } = await import("/static/api.js");
        const { count, columns } = decode_points(Uint8Array.from(numbers).buffer);
        return { count, columns: Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, [...values]])) };
    }, [...new Uint8Array(bytes)]);
    const { x, y, u_x, u_y, displacement, sigma_v } = snapshot.columns;
    assert.deepEqual(Object.keys(snapshot.columns), ["x", "y", "u_x", "u_y", "displacement", "sigma_v"]);
    displacement.forEach((length, i) => assert.ok(Math.abs(length - Math.hypot(u_x[i], u_y[i])) < 1e-5 * (1 + length)));
    const below = y.map((height, i) => (height < 1e-6 && Math.abs(x[i]) < 1e-6 ? sigma_v[i] : 0)).reduce((a, b) => Math.max(a, b));
    assert.ok(below > 2e5 && below < 4.5e5, `${below} Pa below 20 m of 1800 kg/m3, from the mean of an element 2 m high that fails`);
    assert.equal((await fetch(`${url}${address}?fields=r_u`)).status, 400, "a dry scene has no r_u");

    await page.selectOption("#view-source", { label: "FEM mesh" });
    await until("the mesh", async () => /elements$/.test(await text_of("#view-count")));
    await page.selectOption("#view-field", "sigma_v");
    await page.check("#view-vectors");
    for (const [id, value] of [["x1", 1], ["y1", 25], ["x2", 1], ["y2", 0]]) await page.fill(`#cut-${id}`, String(value));
    await page.waitForSelector("#profile:not([hidden]) svg.plot > path.curve");
    assert.match(await text_of("#view-range"), /σ′_v \[kPa\]/);
    const longest = Math.max(...displacement);
    const shown = Number(/Longest vector ([\d.]+) m/.exec(await text_of("#view-vectors-note"))[1]);
    assert.ok(Math.abs(shown / longest - 1) < 0.01, `${shown} of ${longest}`);
    await screenshot(page, "real_contours");
    await page.click("#cut-clear");
    await page.uncheck("#view-vectors");
});

test("a run gets another title, is found by it, and its removal says what it gives back", async () => {
    const run = page.url().split("/").at(-1);
    await page.click("#rename");
    await page.fill("#rename-text", "Renamed column");
    await page.keyboard.press("Enter");
    await until("the new title", async () => (await text_of("#run-title")) === "Renamed column");
    assert.equal((await answer_of("/v1/runs?search=renamed%20COL")).runs[0].id, run);
    assert.match(execFileSync(program("breach"), ["--server", url, "rename", run, study.title], { encoding: "utf8" }), /./);
    await until("the old one again", async () => (await text_of("#run-title")) === study.title);
    await page.click("#remove");
    const [use] = (await answer_of("/v1/storage")).runs.filter(({ id }) => id === run);
    await until("what it gives back", async () => /^This frees [\d.]+ [KM]B of disk/.test(await text_of("#remove-frees")));
    const [, value, unit] = /frees ([\d.]+) ([KM])B/.exec(await text_of("#remove-frees"));
    assert.ok(Math.abs((value * (unit === "M" ? 1e6 : 1e3)) / use.freed_bytes - 1) < 0.01, `${value} ${unit}B of ${use.freed_bytes}`);
    await page.keyboard.press("Escape");
});

test("variants are curves of their own, and a trigger's threshold and firing are drawn", async () => {
    const several = structuredClone(study);
    const friction = (coefficient) => [`/mpm/floor/friction/0/coefficient=${coefficient}`];
    Object.assign(several, { name: "two-floors", title: "Weak and strong floor", transfer_times: [0.5],
        triggers: [{ kind: "criterion", name: "strained", when: "epsilon_q_avg > 0.05", snapshot_interval_s: 0.02 }],
        variants: [{ name: "weak", overrides: friction(0.3) }, { name: "strong", overrides: friction(0.6) }] });
    await page.click("nav [data-opens=submit]");
    await write_json(page, JSON.stringify(several));
    await page.click("#submit");
    await until("its title", async () => (await text_of("#run-title")) === several.title);
    await until("the end of the run", async () => /usable|questionable/.test(await text_of("#run-state")), 120000);
    await until("two curves of two points", async () => (await markers()) === 2 &&
        (await page.locator("#runout-plot svg.plot > .marker.series-1").count()) === 2);
    await until("the threshold", async () => (await page.locator("#telemetry-plots .level-text").allTextContents()).join() === "strained 0.05");
    await until("the firing", async () => (await page.locator("#telemetry-plots .event-text").count()) >= 4);
    const [weak, strong] = (await answer_of(`/v1/runs/${page.url().split("/").at(-1)}/results`)).rows
        .filter((row) => row.transfer_time === 0.5).sort((a, b) => b.runout - a.runout);
    assert.deepEqual([weak.variant, strong.variant], ["weak", "strong"]);
    await page.selectOption("#telemetry-source", { label: "MPM from t_T = 0.5 s, strong" });
    await until("the front's curve", async () =>
        (await page.locator("#telemetry-plots figcaption").allTextContents()).includes("Front"));
    await screenshot(page, "real_variants");
    await page.click("#run-list li:last-child a");
    await until("the first run again", async () => (await text_of("#run-title")) === study.title);
});

test("its report says first what must be known, and printed nothing of it is cut off", async () => {
    const [run] = (await answer_of("/v1/runs")).runs.filter(({ name }) => name === "two-floors");
    const paper = await report_of(run.id, "two-floors");
    assert.ok(await paper.isVisible("#verdict"));
    assert.ok(await paper.locator(".wide.many").count() >= 3, "there are wide tables");
    await printed_whole(paper, "two-floors");
    await paper.close();
});

test("a scene without a FEM is shown by variant: no transfer time, no triggers, its factors of safety", async () => {
    const read = (file) => JSON.parse(readFileSync(new URL(`../../workflows/${file}`, import.meta.url), "utf8"));
    const flow = { ...read("studies/flow_slope.json"), scene: read("scenes/flow_slope.json") };
    flow.variants = flow.variants.filter(({ name }) => ["s_r_9", "s_r_24"].includes(name));
    const submit = async (sent) => {
        await page.click("nav [data-opens=submit]");
        await write_json(page, JSON.stringify(sent));
        await page.click("#submit");
        await until("its title", async () => (await text_of("#run-title")) === sent.title);
        await until("the end of the run", async () => /usable|questionable/.test(await text_of("#run-state")), 120000);
    };
    await submit(flow);
    await until("one marker per variant", async () => (await markers()) === 2);
    assert.equal(await text_of("#runout-title"), "Runout by variant");
    assert.ok(!(await page.isVisible("#triggers")) && !/transfer time/.test(await page.textContent("#runout-table thead tr th:first-child .point")));
    assert.deepEqual(await page.locator("#runout-rows th").allTextContents(), ["s_r_9", "s_r_24"]);
    assert.deepEqual(await page.locator("#telemetry-source option").allTextContents(), ["MPM, s_r_9", "MPM, s_r_24"]);
    const rows = (await answer_of(`/v1/runs/${page.url().split("/").at(-1)}/results`)).rows;
    const shown = await page.locator('#runout-rows [data-column="factor_of_safety"]').allTextContents();
    assert.deepEqual(shown.map(Number), rows.map((row) => Number(row.factor_of_safety.toPrecision(3))));
    await page.selectOption("#runout-measure", "factor_of_safety");
    assert.equal(await text_of("#runout-title"), "Factor of safety by variant");
    await page.click('#runout-rows tr:first-child [data-column="factor_of_safety"]');
    await page.waitForSelector("#provenance[open] .step");
    assert.match(await text_of("#provenance-where"), new RegExp(`Exactly ${rows[0].factor_of_safety}`));
    assert.deepEqual(await page.locator("#provenance .step h3").allTextContents(), ["lem_tool, s_r_9"]);
    await page.keyboard.press("Escape");
    await screenshot(page, "static_both");
    const paper = await report_of(page.url().split("/").at(-1), "static");
    assert.deepEqual(await paper.$$eval("section", (all) => all.filter((each) => !each.querySelector("figure, table, li")).length), 0);
    await printed_whole(paper, "static");
    await paper.close();

    const { mpm, ...standing } = flow.scene;
    await submit({ ...flow, title: "Stability alone", name: "stability-alone", scene: standing });
    // The run before had as many markers of the same quantity: only what is offered tells that this one is shown.
    const offered = async () => (await page.locator("#runout-measure option:not([hidden])").allTextContents()).join();
    await until("its only quantity", async () => (await offered()) === "factor of safety");
    await until("one marker per variant", async () => (await markers()) === 2);
    assert.equal(await text_of("#runout-title"), "Factor of safety by variant");
    for (const none of ["#particles", "#telemetry", "#triggers"]) assert.ok(!(await page.isVisible(none)), `${none} has nothing to show`);
    await screenshot(page, "static_stability");
    await page.click("#run-list li:last-child a");
    await until("the first run again", async () => (await text_of("#run-title")) === study.title);
});

test("the finished run is photographed, light and dark", async () => {
    await page.click(`#runout-rows tr[data-key="${study.transfer_times[1]}/"] button`);
    for (const theme of ["light", "dark"]) {
        while ((await page.getAttribute("html", "data-theme")) !== theme) await page.click("#theme");
        await until("soil", async () => (await canvas_facts(page)).share > 0.02);
        await page.waitForTimeout(300); // transitions
        await screenshot(page, `real_${theme}`);
    }
    assert.deepEqual(live.browser.complaints, []);
    assert.deepEqual(live.browser.foreign, []);
});

test("a service that ends is noticed, and what was seen stays", async () => {
    await live.service.stop();
    await until("the notice", async () => /Connection lost/.test(await text_of("#connection")), 30000);
    assert.equal(await markers(), study.transfer_times.length);
});
