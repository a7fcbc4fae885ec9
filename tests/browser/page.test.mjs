// The page against a stand-in server: what it shows, what it asks before it acts, what it does when the server goes.
import assert from "node:assert/strict";
import { readdirSync, readFileSync, statSync } from "node:fs";
import path from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { build_folder, canvas_facts, open_browser, open_run as open_run_of, screenshot, until } from "./browser.mjs";
import { write_json } from "./form_page.mjs";
import { drawn, FakeApi, some_flagged, study, twelve_curves, twelve_variants, two_variants } from "./fake_api.mjs";

const api = new FakeApi({ pace: 6, points: 5000 });
let url;
let page;
let browser;

before(async () => {
    url = await api.open();
    api.add_run(study, { began: Date.now() - 60000 });
    browser = await open_browser();
    page = browser.page;
});

after(async () => {
    await browser.close();
    await api.close();
});

/// A finished run of two variants with triggers that fired; made when a test first asks for it.
let of_variants = null;
function variants_run() {
    of_variants ??= api.add_run(two_variants, { began: Date.now() - 60000 }).id;
    return of_variants;
}

const open_run = (id) => open_run_of(page, url, id);
const text_of = (selector) => page.textContent(selector);
const markers = () => page.locator("#runout-plot svg.plot > .marker.series-0").count();

test("the start page lists runs and opens one", async () => {
    await page.goto(url);
    await page.waitForSelector("#run-list a");
    assert.match(await text_of("#run-list a"), /fake-column.*partial/s);
    await until("connection", async () => (await text_of("#connection")) === "Live");
    await page.click("#run-list a");
    await page.waitForSelector("#run:not([hidden])");
    assert.equal(await text_of("#run-title"), "A column made of formulas");
    assert.equal(await page.getAttribute("#run-list a", "aria-current"), "page");
});

test("no number of the run before stands under the name of the next", async () => {
    const next = api.add_run({ ...study, name: "next", title: "The next run" }, { began: Date.now() - 60000 }).id;
    await page.waitForSelector("#runout-rows tr");
    let answer;
    const asked = new Promise((resume) => {
        answer = resume;
    });
    await page.route(`**/runs/${next}/results`, async (route) => {
        await asked;
        await route.continue();
    });
    await page.goto(`${url}/#/runs/${next}`);
    await until("its name", async () => (await text_of("#run-title")) === "The next run");
    for (const part of ["#runout-rows", "#runout-csv", "#cost-rows"])
        assert.equal(await page.isVisible(part), false, part);
    assert.equal(await page.isVisible("#cost-title"), true);
    assert.match(await page.$eval("#cost-title", (title) => getComputedStyle(title, "after").content), /loading/);
    answer();
    await page.waitForSelector("#runout-rows tr");
    assert.match(await page.getAttribute("#runout-csv", "href"), new RegExp(next));
    await page.unroute(`**/runs/${next}/results`);
    api.runs.pop();
});

test("everything comes from this server, and little of it", async () => {
    await open_run("run-1");
    const bytes = await page.evaluate(() => performance.getEntriesByType("resource")
        .filter((entry) => entry.name.includes("/static/")).reduce((sum, entry) => sum + entry.decodedBodySize, 0));
    console.log(`page without data: ${bytes} bytes`);
    const folder = fileURLToPath(new URL("../../services/web/static", import.meta.url));
    const shipped = readdirSync(folder).reduce((sum, name) => sum + statSync(path.join(folder, name)).size, 0);
    console.log(`all files that are served: ${shipped} bytes`);
    assert.ok(bytes > 20000 && shipped < 530000);
    assert.deepEqual(browser.foreign, []);
});

test("the curve has one marker per finished transfer time, and marks the failed one", async () => {
    await open_run("run-1");
    await until("seven markers", async () => (await markers()) === 7);
    assert.equal(await page.locator("#runout-plot svg.plot > .mark.failed").count(), 1);
    assert.equal(await page.isVisible("#runout-rows .variant"), false);
    assert.equal(await text_of("#runout-progress"), "7 of 8 transfer times finished");
    assert.equal(await page.locator("#runout-rows tr").count(), 8);
    assert.equal(await page.getAttribute("#runout-csv", "href"), "/v1/runs/run-1/results?format=csv");
    const labels = await page.locator("#runout-plot .label").allTextContents();
    assert.deepEqual(labels, ["transfer time t_T [s]", "runout from the toe [m]"]);
});

test("the curve is read by pointer and by keyboard", async () => {
    await open_run("run-1");
    await until("markers", async () => (await markers()) === 7);
    await page.focus("#runout-plot svg.plot");
    await page.keyboard.press("Home");
    assert.match(await text_of("#runout-plot .readout"), /^t_T = 0.25 s: 99 % of the mobile soil 14.04 m$/);
    await page.keyboard.press("ArrowRight");
    assert.match(await text_of("#runout-plot .readout"), /^t_T = 0.5 s/);
    await page.keyboard.press("Enter");
    await page.waitForSelector("#provenance[open] .step");
    await page.click("#provenance-look");
    await until("particles of 0.5 s", async () =>
        (await page.$eval("#view-source", (s) => s.selectedOptions[0].textContent)) === "MPM from t_T = 0.5 s");
    const picture = page.locator("#runout-plot svg.plot");
    const { width } = await picture.boundingBox();
    await picture.hover({ position: { x: 0.73 * width, y: 50 } });
    assert.match(await text_of("#runout-plot .readout"), /^t_T = 1.5 s/);
});

test("particles are drawn, move with the slider, zoom and change colour", async () => {
    await open_run("run-1");
    await until("soil on the canvas", async () => (await canvas_facts(page)).share > 0.05);
    const end = await canvas_facts(page);
    assert.ok(end.colours > 40, `${end.colours} colours`);
    assert.ok(end.two_commonest < 0.8, `${end.two_commonest} of the soil has two colours`);
    await page.focus("#view-time");
    await page.keyboard.press("Home");
    await until("first snapshot", async () => (await text_of("#view-now")).startsWith("t = 0 s"));
    await until("another picture", async () => (await canvas_facts(page)).sum !== end.sum);
    await page.keyboard.press("End");
    await until("the same picture again", async () => (await canvas_facts(page)).sum === end.sum);
    await page.focus("#view");
    await page.keyboard.press("+");
    await until("a larger picture", async () => (await canvas_facts(page)).share > 1.1 * end.share);
    await page.keyboard.press("0");
    await until("the whole again", async () => (await canvas_facts(page)).sum === end.sum);
    await page.selectOption("#view-field", "region");
    await until("two regions", async () => (await canvas_facts(page)).two_commonest > 0.97);
    assert.deepEqual((await page.locator("#view-regions li").allTextContents()).map((name) => name.trim()),
                     ["base", "column"]);
    await page.selectOption("#view-field", "speed");
});

test("the scale of colours can be set by hand", async () => {
    await open_run("run-1");
    await until("soil", async () => (await canvas_facts(page)).colours > 40);
    await page.selectOption("#view-scale-of", "hand");
    await page.fill("#view-high", "1000");
    await page.press("#view-high", "Tab");
    await until("one end of the scale", async () => (await canvas_facts(page)).two_commonest > 0.97);
    assert.match(await text_of("#view-range"), /0 to 1000/);
    await page.selectOption("#view-scale-of", "all");
});

test("playing runs to the last snapshot and stops there", async () => {
    await open_run("run-1");
    await until("snapshots", async () => /of 25/.test(await text_of("#view-now")));
    await page.evaluate(() => {
        window.times_shown = new Set();
        new MutationObserver(([{ target }]) => window.times_shown.add(target.textContent)).observe(document.getElementById("view-now"), { childList: true });
    });
    await page.click("#view-play");
    await until("an early snapshot", async () => (await page.evaluate(() => [...window.times_shown])).some((text) => /\([2-9] of 25\)/.test(text)));
    await until("the end", async () => /Play/.test(await text_of("#view-play")));
    assert.match(await text_of("#view-now"), /25 of 25/);
});

test("the FEM mesh is drawn deformed", async () => {
    await open_run("run-1");
    await page.selectOption("#view-source", { label: "FEM mesh" });
    await until("elements", async () => (await text_of("#view-count")) === "800 elements");
    await until("colours", async () => (await canvas_facts(page)).colours > 20);
});

const measures_speed = process.env.BREACH_BROWSER_SPEED; // set it to print times per picture
const spread = (times) => [["median", 0.5], ["95 % within", 0.95], ["longest", 1]]
    .map(([name, share]) => `${name} ${times[Math.floor(share * (times.length - 1))].toFixed(1)} ms`).join(", ");

/// The page's own processor time, which other programs on the machine do not lengthen. Call the result with a count.
async function processor_clock() {
    const devtools = await page.context().newCDPSession(page);
    await devtools.send("Performance.enable", { timeDomain: "threadTicks" });
    const read = async () => (await devtools.send("Performance.getMetrics")).metrics
        .find(({ name }) => name === "ThreadTime")?.value ?? NaN;
    const began = await read();
    return async (count) => {
        const taken = 1000 * ((await read()) - began);
        await devtools.detach();
        return `main thread ${(taken / count).toFixed(1)} ms of CPU per snapshot, fetching and decoding included`;
    };
}

test("100,000 particles are drawn whole", async () => {
    await open_run(api.add_run({ ...study, name: "large", transfer_times: [1] }, { points: 100000, began: Date.now() - 60000 }).id);
    await until("100,000 points", async () => /^(99|100)\d{3} points$/.test(await text_of("#view-count")), 40000);
    await until("soil", async () => (await canvas_facts(page)).share > 0.05);
    if (!measures_speed) return;
    const picture = await page.evaluate(async () => {
        const { PointView } = await import("/static/points.js");
        const paint = PointView.prototype.paint;
        const taken = [];
        PointView.prototype.paint = function timed() {
            paint.call(this);
            taken.push(this.paint_time);
        };
        const canvas = document.getElementById("view");
        for (let i = 0; i < 40; i += 1) {
            canvas.dispatchEvent(new KeyboardEvent("keydown", { key: i % 2 ? "ArrowLeft" : "ArrowRight" }));
            await new Promise((resume) => setTimeout(resume, 30));
        }
        PointView.prototype.paint = paint;
        return taken.sort((a, b) => a - b);
    });
    console.log(`painting 100,000 points: least ${picture[0].toFixed(1)} ms, ${spread(picture)}`);
    assert.ok(picture.length >= 10);

    // Playing: once while the snapshots come, once from memory; what a person sees is the distance between pictures.
    for (const round of ["while fetched", "from memory"]) {
        const cpu_per_snapshot = await processor_clock();
        const frames = await page.evaluate(async () => {
            const pictures = [];
            let last = performance.now();
            let going = true;
            const look = (now) => {
                pictures.push(now - last);
                last = now;
                if (going) requestAnimationFrame(look);
            };
            requestAnimationFrame(look);
            document.getElementById("view-play").click();
            while (!document.getElementById("view-play").textContent.includes("Play")) await new Promise((go) => setTimeout(go, 50));
            going = false;
            return pictures.slice(1).sort((a, b) => a - b);
        });
        console.log(`playing 100,000 points ${round}: ${frames.length} pictures apart by ${spread(frames)}; ` +
                    `${frames.filter((each) => each > 33.4).length} above 33 ms; ${await cpu_per_snapshot(25)}`);
        assert.match(await text_of("#view-now"), /25 of 25/);
    }
});

test("a mesh of 20,000 elements is drawn", async () => {
    await open_run("run-1");
    await until("soil", async () => (await canvas_facts(page)).share > 0.05);
    const times = await page.evaluate(async (pictures) => {
        const { PointView } = await import("/static/points.js");
        const [columns, rows] = [201, 101];
        const count = columns * rows;
        const of = (f) => Float32Array.from({ length: count }, (_, n) => f(n % columns, Math.floor(n / columns)));
        const quads = [];
        for (let j = 0; j < rows - 1; j += 1) for (let i = 0; i < columns - 1; i += 1) {
            const n = j * columns + i;
            quads.push(n, n + 1, n + columns + 1, n + columns);
        }
        const view = new PointView(document.getElementById("view"));
        view.set_box({ x: [0, 200], y: [0, 100] });
        view.resize();
        view.show({ time: 0, count, regions: [], quads: Uint32Array.from(quads),
                    columns: { x: of((i) => i), y: of((_, j) => j), r_u: of((i, j) => Math.abs(Math.sin(i / 30) * Math.cos(j / 20))) } },
                  { field: "r_u", low: 0, high: 1 }, 1);
        const taken = [];
        for (let i = 0; i < pictures; i += 1) {
            await new Promise((resume) => setTimeout(resume, 20));
            view.paint();
            view.context.getImageData(0, 0, 1, 1); // waits for the picture
            taken.push(view.paint_time);
        }
        return taken.sort((a, b) => a - b);
    }, measures_speed ? 15 : 1);
    if (measures_speed) console.log(`painting 20,000 elements: least ${times[0].toFixed(1)} ms, ${spread(times)}`);
    assert.ok((await canvas_facts(page)).colours > 20);
});

test("telemetry is drawn as curves and the other monitors are at hand", async () => {
    await open_run("run-1");
    await until("eight panels", async () => (await page.locator("#telemetry-plots figure").count()) === 8);
    assert.deepEqual(await page.locator("#telemetry-plots figcaption").allTextContents(),
                     ["Crest displacement", "Kinetic energy", "Liquefaction depth", "Pore pressure ratio", "Failure surfaces",
                      "Jacobian ratio, averages", "Deviatoric strain, average", "Work"]);
    const path = await page.getAttribute("#telemetry-plots figure:nth-child(2) .curve.series-0[d*=L]", "d");
    assert.ok(path.length > 500, "the curve has many points");
    assert.equal(await page.locator("#telemetry-plots figure:nth-child(1) svg.plot > .event").count(), 8);
    assert.ok(await page.isHidden("#triggers"), "this study has none");
    await page.click("#telemetry-more summary");
    await until("the other monitor", async () => (await page.locator("#telemetry-others figure .curve").count()) > 0);
});

test("a task shows its fault, attempts, files with hashes, and log", async () => {
    await open_run("run-1");
    assert.equal(await page.locator("#task-rows tr").count(), 18);
    await page.click(".flow-chip.bad");
    assert.match(await text_of("#task-fault"), /Exit code 70: mass differs/);
    await until("the log", async () => /transfer_tool step 59/.test(await text_of("#log")));
    await page.click("#task-rows tr:nth-child(2) button");
    await until("the FEM's log", async () => /fem_solver step 59/.test(await text_of("#log")));
    const link = page.locator("#task-artifacts a").first();
    assert.match(await link.getAttribute("href"), /^\/v1\/artifacts\/[0-9a-f]{64}$/);
    assert.equal(await page.evaluate(() => document.activeElement.id), "task-title");
});

test("a faulty study is refused with every fault in its place", async () => {
    await page.goto(url);
    await page.click("nav [data-opens=submit]");
    await write_json(page, JSON.stringify({ scene: { materials: { sand: { density: -1800 } } } }, null, 2));
    await page.click("#submit");
    await page.waitForSelector("#fault-list li");
    assert.deepEqual(await page.locator("#fault-list code").allTextContents(),
                     ["/transfer_times", "/scene/materials/sand/density"]);
    assert.match(await text_of("#fault-title"), /2 faults/);
    await screenshot(page, "page_faults");
    await page.click("#fault-list li:nth-child(2) button");
    assert.equal(await page.evaluate(() => getSelection().toString()), "-1800");
    await write_json(page, "{ not json");
    await page.click("#submit");
    await until("the reason", async () => /not JSON/.test(await text_of("#fault-title")));
    await page.keyboard.press("Escape");
});

test("an example is loaded, planned, submitted, and fills in live", async () => {
    await page.goto(url);
    await page.click("nav [data-opens=submit]");
    await until("the examples", () => page.isVisible("#examples"));
    await page.selectOption("#examples", { index: 1 });
    await until("the example's text", async () => (await page.inputValue("#study")).includes("breachline-study/1"));
    await page.click("#show-plan"); // a whole study leads to the last step
    await until("a plan", async () => /softening/.test(await text_of("#plan")));
    assert.deepEqual(await page.locator("#plan tr:last-child > *").allTextContents(),
                     ["⊘ left out", "gmsh", "regions are blocks", "/section"]);
    api.pace = 1000;
    await page.click("#submit");
    await until("the new run is open", () => page.url().endsWith(`#/runs/${api.runs.at(-1).id}`));
    await until("it runs", async () => /running/.test(await text_of("#run-state")));
    const run = api.runs.at(-1);
    const early = await markers();
    run.began -= 700e3; // the clock of the stand-in moves on
    await until("some markers, not all", async () => (await markers()) > early && (await markers()) < 7);
    run.began -= 300e3;
    await until("the end", async () => /partial/.test(await text_of("#run-state")));
    api.pace = 6;
    await until("all markers", async () => (await markers()) === 7);
    assert.ok(await page.isHidden("#cancel"), "nothing is left to cancel");
});

test("cancelling asks first", async () => {
    await open_run(api.add_run({ ...study, name: "to-cancel" }, { pace: 600 }).id);
    const asked = (order = "cancel") => api.requests.filter((line) => line.endsWith(`/${order}`)).length;
    await page.click("#cancel");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Keep running");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#cancel-dialog:not([open])", { state: "attached" });
    assert.equal(asked(), 0);
    await page.click("#cancel");
    await page.keyboard.press("Escape");
    assert.equal(asked(), 0);
    await page.click("#cancel");
    await page.click("#cancel-dialog .danger");
    await until("cancelled", async () => /cancelled/.test(await text_of("#run-state")));
    assert.equal(asked(), 1);
    await page.click("#retry");
    await until("it runs again", async () => /running/.test(await text_of("#run-state")));
    assert.equal(asked("retry"), 1);
});

test("a run that is over is removed when asked twice", async () => {
    const run = api.add_run({ ...study, name: "to-remove" }, { pace: 1e-3 });
    await open_run(run.id);
    await page.click("#remove");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Keep it");
    await until("what it gives back", async () =>
        (await text_of("#remove-frees")) === "This frees 12.3 MB of disk; 4 MB more are shared with other runs and stay.");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#remove-dialog:not([open])", { state: "attached" });
    assert.ok(!api.requests.includes(`DELETE /v1/runs/${run.id}`));
    await page.click("#remove");
    await page.click("#remove-dialog .danger");
    await until("it is gone from the list", async () => !/to-remove/.test(await text_of("#run-list")));
    assert.ok(api.requests.includes(`DELETE /v1/runs/${run.id}`));
});

test("runs are found by a part of their name, title or id, and renamed", async () => {
    const run = api.add_run({ ...study, name: "to-rename" }, { pace: 1e-3 });
    await open_run(run.id);
    await page.click("#rename");
    assert.equal(await page.inputValue("#rename-text"), study.title);
    await page.fill("#rename-text", " ");
    await page.keyboard.press("Enter");
    await until("the refusal", () => page.isVisible("#rename-fault"));
    await page.fill("#rename-text", "Weak beach, second try");
    await page.keyboard.press("Enter");
    await until("the new title", async () => (await text_of("#run-title")) === "Weak beach, second try");
    await page.fill("#run-search", "weak BEACH");
    await until("only it", async () => (await page.locator("#run-list li").count()) === 1);
    assert.match(await text_of("#run-list"), /to-rename.*Weak beach, second try/);
    await page.fill("#run-search", "no such run");
    await until("none", async () => (await text_of("#no-runs")) === "None has this in its name, title or id.");
    assert.equal(await text_of("#run-title"), "Weak beach, second try", "the open run stays");
    await page.fill("#run-search", "");
    await until("all", async () => (await page.locator("#run-list li").count()) === api.runs.length);
});

test("a run is paused and resumed, and says how long it will take", async () => {
    await open_run(api.add_run({ ...study, name: "to-pause" }, { pace: 600 }).id);
    await until("time left", async () => /about 9 min \d+ s left/.test(await text_of("#run-summary")));
    await page.click("#pause");
    await until("paused", async () => /paused/.test(await text_of("#run-state")));
    assert.match(await text_of("#run-summary"), /nothing new is started/);
    assert.ok(await page.isHidden("#pause"));
    await page.click("#resume");
    await until("running", async () => /running/.test(await text_of("#run-state")));
    assert.ok(await page.isHidden("#retry"), "nothing to retry while it runs");
});

test("where a runout's error is known, the curve has a band and the readout says it", async () => {
    await open_run(api.add_run({ ...study, name: "with-draws", draws: 5 }, { began: Date.now() - 60000 }).id);
    await until("seven whiskers", async () => (await page.locator("#runout-plot svg.plot > .whisker.series-0").count()) === 7);
    assert.equal(await page.locator("#runout-plot svg.plot > .error-band").count(), 1);
    assert.match(await text_of("#runout-plot .legend"), /error of one run/);
    await page.focus("#runout-plot svg.plot");
    await page.keyboard.press("Home");
    assert.match(await text_of("#runout-plot .readout"), /^t_T = 0.25 s: 99 % of the mobile soil 14.04 ± 0.5 m$/);
    await page.selectOption("#runout-measure", "runout_largest");
    assert.equal(await page.locator("#runout-plot .whisker").count(), 0, "the error is that of the runout");
    await page.selectOption("#runout-measure", "runout");
    await open_run("run-1");
    await until("markers", async () => (await markers()) === 7);
    assert.equal(await page.locator("#runout-plot .whisker").count(), 0, "no error is known");
});

test("a study with draws shows their mean and band, and each draw behind it", async () => {
    await open_run(api.add_run(drawn, { began: Date.now() - 60000 }).id);
    await until("seven means", async () => (await markers()) === 7);
    assert.equal(await page.locator("#runout-plot svg.plot > .marker.series-1").count(), 0, "one curve, not three");
    assert.equal(await page.locator("#runout-plot svg.plot > .error-band").count(), 1);
    assert.match(await text_of("#runout-plot .legend"), /standard deviation of the repeats/);
    assert.equal(await page.locator("#runout-rows tr").count(), 8);
    assert.match(await text_of("#runout-progress"), /^21 of 24 runs \(3 repeats each\) finished$/);
    assert.match(await page.getAttribute("#runout-csv", "href"), /table=means$/);
    await page.focus("#runout-plot svg.plot");
    await page.keyboard.press("Home");
    // 14.04, 14.54 and 15.04 m.
    assert.match(await text_of("#runout-plot .readout"), /^t_T = 0.25 s: 99 % of the mobile soil 14.54 ± 0.5 m/);
    await page.selectOption("#runout-measure", "runout_largest");
    assert.equal(await page.locator("#runout-plot svg.plot > .whisker").count(), 7, "every measure has its scatter");
    await page.selectOption("#runout-measure", "runout");
    await screenshot(page, "draws_mean");
    assert.equal(await page.textContent('#runout-rows tr[data-key="1//mean"] [data-column="runout"]'), "16 ± 0.5");
    await page.click('#runout-rows tr[data-key="1//mean"] [data-column="runout"]');
    await until("three draws", async () => (await page.locator("#runout-rows tr").count()) === 3);
    assert.match(await text_of("#runout-note"), /Only the repeats of t_T = 1 s/);
    assert.ok(await page.isEnabled('#runout-rows tr[data-key="1/d2"] th button'), "its particles can be looked at");
    await screenshot(page, "draws_of_one_mean");
    await page.selectOption("#runout-draws", "means");
    await until("means again", async () => (await page.locator("#runout-rows tr").count()) === 8);
    await page.selectOption("#runout-draws", "runs");
    await until("all draws", async () => (await page.locator("#runout-rows tr").count()) === 24);
    await page.selectOption("#runout-draws", "means");
    await open_run("run-1");
    await until("a run without draws", async () => (await markers()) === 7);
    assert.ok(await page.isHidden("#runout-draws-label"));
});

test("every variant has its own curve, rows, chips and particles", async () => {
    await open_run(variants_run());
    await until("two curves", async () => (await page.locator("#runout-plot svg.plot > .marker.series-1").count()) === 7);
    assert.equal(await markers(), 7);
    assert.deepEqual((await page.locator("#runout-plot .legend li").allTextContents()).map((name) => name.trim()),
                     ["softened", "not-softened", "failed", "window", "plateau"]);
    assert.equal(await text_of("#runout-progress"), "14 of 16 runs (transfer times × 2 variants) finished");
    assert.equal(await page.locator("#runout-rows tr").count(), 16);
    const cells = async (key) => page.locator(`#runout-rows tr[data-key="${key}"] td`).allTextContents();
    assert.deepEqual((await cells("1/softened")).slice(0, 3), ["softened", "✓ succeeded", "15.5"]);
    assert.deepEqual((await cells("1/not-softened")).slice(0, 3), ["not-softened", "✓ succeeded", "8.9"]);
    assert.deepEqual((await page.locator("#flow-head span").allTextContents()),
                     ["t_T [s]", "transfer", "MPM, softened", "MPM, not-softened"]);
    assert.equal(await page.locator(".flow-column:nth-child(1) .flow-chip").count(), 3);
    await page.selectOption("#runout-measure", "runout_largest");
    await page.focus("#runout-plot svg.plot");
    await page.keyboard.press("Home");
    assert.match(await text_of("#runout-plot .readout"), /softened 16.54 m · not-softened 9.944 m/);
    await page.selectOption("#runout-measure", "runout");
    await page.click('#runout-rows tr[data-key="1.5/not-softened"] th button');
    await until("its particles", async () =>
        (await page.$eval("#view-source", (s) => s.selectedOptions[0].textContent)) === "MPM from t_T = 1.5 s, not-softened");
    const sources = await page.locator("#view-source option").allTextContents();
    assert.equal(new Set(sources).size, 17, "every source has a name of its own");
});

test("a runout that still moves, is questionable or carries no flags does not look sound, in the curve and in the table", async () => {
    const run = api.add_run({ ...study, name: "flagged", title: "Some of it cannot be believed" },
                            { began: Date.now() - 60000, flagged: some_flagged, entangles: 2.1, breaks: [] });
    await open_run(run.id);
    await until("eight markers", async () => (await markers()) === 8);
    const classes = await page.locator("#runout-plot svg.plot > .marker").evaluateAll((all) => all.map((one) => one.getAttribute("class")));
    assert.deepEqual(classes.map((each) => each.replace("marker series-0", "").trim()),
                     ["", "bound", "doubtful", "bound doubtful", "", "", "", ""]);
    // In one go: the plot is drawn anew when the page looks again.
    const paint = await page.evaluate(() => [...document.querySelectorAll("#runout-plot svg.plot > .marker")].map((one) => {
        const { fill, strokeDasharray, fillOpacity } = getComputedStyle(one);
        return { hollow: fill === getComputedStyle(one.closest(".card")).backgroundColor, dashed: strokeDasharray !== "none", pale: Number(fillOpacity) < 0.5 };
    }));
    assert.deepEqual(paint.map(({ hollow, dashed, pale }) => `${hollow ? "hollow" : "filled"}${dashed ? " dashed" : ""}${pale ? " pale" : ""}`),
                     ["filled", "hollow", "hollow dashed", "hollow dashed", "filled", "filled", "filled", "filled"]);
    // Arrows point upwards, from their own markers.
    const transforms = (selector) => page.locator(`#runout-plot svg.plot > ${selector}`).evaluateAll((all) => all.map((one) => one.getAttribute("transform")));
    assert.deepEqual(await transforms(".arrow"), await transforms(".marker.bound"));
    const [arrow, marker] = await page.evaluate(() => [".arrow", ".marker.bound"].map((one) =>
        document.querySelector(`#runout-plot svg.plot > ${one}`).getBoundingClientRect().top));
    assert.ok(arrow < marker - 3, `the arrow's head, at ${arrow}, is above its marker, at ${marker}`);
    const titles = await page.locator("#runout-plot svg.plot > .marker").evaluateAll((all) => all.map((one) => one.querySelector("title")?.textContent));
    assert.match(titles[1], /moving, 12 % in motion\nstill moving: .*the runout is a lower bound/);
    assert.match(titles[2], /at rest\nnumerical share: the scheme took 31 %/);
    assert.match(titles[5], /implausible: 19 looks like kN\/m3/);
    assert.deepEqual((await page.locator("#runout-plot .legend li").allTextContents()).map((name) => name.trim()),
                     ["99 % of the mobile soil", "still moving: the runout is a lower bound", "questionable"]);
    await page.focus("#runout-plot svg.plot");
    await page.keyboard.press("Home");
    await page.keyboard.press("ArrowRight");
    assert.match(await text_of("#runout-plot .readout"), /m \(still moving: the runout is a lower bound\)$/);
    assert.ok(await page.isHidden("#runout-note"));

    const cells = async (time) => (await page.locator(`#runout-rows tr[data-key="${time}/"] td`).allTextContents()).slice(1, 5);
    assert.deepEqual(await cells(0.25), ["✓ succeeded", "14.04", "at rest", "none"]);
    assert.deepEqual(await cells(0.5), ["⚠ questionable", "≥ 14.92", "moving, 12 % in motion", "still moving"]);
    assert.deepEqual((await cells(0.75)).slice(0, 1), ["⚠ questionable"]);
    assert.deepEqual((await cells(1)).slice(3), ["still moving; numerical share"]);
    assert.deepEqual(await cells(1.5), ["✓ succeeded", "13.42", "at rest", "1 warning"]);
    const badges = await page.locator("#runout-rows .state").evaluateAll((all) => all.map((one) => one.className.replace("state ", "")));
    assert.deepEqual(badges, ["good", "warn", "warn", "warn", "good", "good", "good", "good"]);

    await page.selectOption("#runout-trust", "sound");
    await until("the sound ones", async () => (await markers()) === 5);
    assert.equal(await page.locator("#runout-rows tr").count(), 5);
    assert.equal(await text_of("#runout-note"), "3 not shown.");
    await page.selectOption("#runout-trust", "all");
    await screenshot(page, "page_flags");

    // The list says it, too; its entangled FEM is a regular end.
    assert.equal(await text_of("#run-state"), "✕ not usable");
    assert.match(await text_of("#run-list a[aria-current]"), /✕ not usable.*1 of 8 runouts flagged implausible/s);
    assert.ok(await page.isHidden("#retry"), "nothing of it has failed");
    const fem = '#task-rows tr:has-text("fem_solver")';
    assert.match(await text_of(fem), /■ ended: entangled at 2.1 s/);
    assert.equal(await page.locator(`${fem} .state.calm`).count(), 1);
    await page.click(`${fem} button`);
    await until("its flag", async () => /entangled the mesh entangled at 2.1 s in element 212/.test(await text_of("#task-flags")));
    assert.ok(await page.isHidden("#task-fault"));
    await page.click('#runout-rows tr[data-key="0.5/"] [data-column="runout"]');
    await page.waitForSelector("#provenance[open] .step");
    assert.match(await text_of("#provenance .step .flags"), /still moving 12 % of the released energy.*\/mpm\/duration/);
    await page.keyboard.press("Escape");
});

test("a transfer time beyond the mesh's regular end is not reached, which is nothing to retry", async () => {
    await open_run(api.add_run({ ...study, name: "short" }, { began: Date.now() - 60000, entangles: 1.6, breaks: [] }).id);
    await until("six markers", async () => (await markers()) === 6);
    assert.match(await text_of("#run-state"), /usable/);
    assert.ok(await page.isHidden("#retry"));
    assert.match(await text_of('#runout-rows tr[data-key="1.75/"]'), /⊘ not reached/);
    assert.deepEqual(await page.locator("#runout-plot svg.plot > .mark title").allTextContents(),
                     Array(2).fill("not reached: its FEM ended regularly at 1.6 s, before this time"));
    assert.equal(await page.locator('#task-rows tr:has-text("not reached")').count(), 4);
});

test("the table of runouts fits at 1400 px; what is folded away comes when asked for", async () => {
    await page.setViewportSize({ width: 1400, height: 900 });
    await open_run(api.add_run({ ...two_variants, name: "wide", title: "Every column" }, { began: Date.now() - 60000, flagged: some_flagged }).id);
    await until("rows", async () => (await page.locator("#runout-rows tr").count()) === 16);
    const hidden_width = () => page.evaluate(() => {
        const region = document.getElementById("runout-table").parentElement;
        return region.scrollWidth - region.clientWidth;
    });
    assert.equal(await hidden_width(), 0);
    assert.ok(await page.isHidden('#runout-rows tr:first-child [data-column="overlap"]'));
    await page.check("#runout-all");
    assert.ok(await page.isVisible('#runout-rows tr:first-child [data-column="overlap"]'));
    await page.uncheck("#runout-all");
    for (const width of [1000, 400]) {
        await page.setViewportSize({ width, height: 900 });
        await page.evaluate(() => document.getElementById("runout-table").parentElement.scrollTo(10000, 0));
        const [time, trace] = await page.evaluate(() => ["th", "td:last-child button"].map((one) => {
            const { left, right } = document.querySelector(`#runout-rows tr:first-child ${one}`).getBoundingClientRect();
            return { left, right };
        }));
        assert.ok(trace.right <= width && time.left >= 0 && time.right < trace.left, `${width} px: the last column is reached, the first stays`);
    }
    await page.setViewportSize({ width: 1400, height: 900 });
});

test("where a task left no result, the origin of its number says why and what is unknown", async () => {
    await open_run("run-1");
    await until("markers", async () => (await markers()) === 7);
    await page.click('#runout-rows tr[data-key="1.25/"] td:last-child button');
    await page.waitForSelector("#provenance[open] .step:nth-of-type(2)");
    assert.match(await text_of("#provenance-chain"), /left no result\.json: it ended as “failed” with exit code 70: mass differs/);
    assert.doesNotMatch(await text_of("#provenance-chain"), /No result\.json yet/);
    await page.keyboard.press("Escape");
});

test("variants at one transfer time stand side by side, each with its name", async () => {
    await open_run(api.add_run(twelve_variants, { began: Date.now() - 60000 }).id);
    await until("twelve markers", async () => (await page.locator("#runout-plot svg.plot > .marker").count()) === 12);
    const places = await page.evaluate(() => [...document.querySelectorAll("#runout-plot svg.plot > .marker")]
        .map((one) => one.getBoundingClientRect().x));
    assert.equal(new Set(places.map(Math.round)).size, 12);
    assert.deepEqual(places, [...places].sort((a, b) => a - b));
    assert.deepEqual((await page.locator("#runout-plot .tick-x").allTextContents()), twelve_variants.variants.map(({ name }) => name));
    assert.deepEqual(await page.locator("#runout-plot .label").allTextContents(), ["variant", "runout from the toe [m]"]);
    await page.focus("#runout-plot svg.plot");
    await page.keyboard.press("End");
    assert.match(await text_of("#runout-plot .readout"), /^strength_x_1.25: .* 13.3 m$/);
    assert.equal(await text_of("#runout-title"), "Runout by variant");
    await screenshot(page, "page_variants_side_by_side");
});

test("twelve variants have curves that differ, by colour and by shape", async () => {
    await open_run(api.add_run(twelve_curves, { began: Date.now() - 60000 }).id);
    await until("all markers", async () => (await page.locator("#runout-plot svg.plot > .marker").count()) === 84);
    const looks = await page.evaluate(() => [...document.querySelectorAll("#runout-plot svg.plot > .marker")].map((one) =>
        ({ colour: getComputedStyle(one).fill, shape: one.getAttribute("d") })));
    assert.equal(new Set(looks.map(({ colour }) => colour)).size, 12);
    assert.equal(new Set(looks.map(({ shape }) => shape)).size, 12);
    await screenshot(page, "page_twelve_curves");
});

/// Least distance in OKLab between any two colours, as they are and as red- and green-blind eyes see them (Machado 2009).
function least_distance(colours) {
    const blind = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                   [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
                   [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]]];
    const times = (matrix, v) => matrix.map((row) => row.reduce((sum, each, i) => sum + each * v[i], 0));
    const linear = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255)
        .map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
    const lab = (rgb) => times([[0.2104542553, 0.793617785, -0.0040720468], [1.9779984951, -2.428592205, 0.4505937099], [0.0259040371, 0.7827717662, -0.808675766]],
        times([[0.4122214708, 0.5363325363, 0.0514459929], [0.2119034982, 0.6806995451, 0.1073969566], [0.0883024619, 0.2817188376, 0.6299787005]],
              rgb.map((value) => Math.min(1, Math.max(0, value)))).map(Math.cbrt));
    return blind.map((eye) => {
        const seen = colours.map((hex) => lab(times(eye, linear(hex))));
        return Math.min(...seen.flatMap((a, i) => seen.slice(i + 1).map((b) => Math.hypot(...a.map((value, k) => value - b[k])))));
    });
}

test("twelve colours of curves and of regions stay apart, for colour-blind eyes too", async () => {
    await open_run("run-1");
    const palettes = await page.evaluate(async () => {
        const { region_count, region_css } = await import("/static/colours.js");
        const found = { regions: Array.from({ length: region_count }, (_, i) => region_css(i)) };
        for (const theme of ["light", "dark"]) {
            document.documentElement.dataset.theme = theme;
            const style = getComputedStyle(document.documentElement);
            found[theme] = Array.from({ length: 12 }, (_, i) => style.getPropertyValue(`--series-${i}`).trim());
        }
        return found;
    });
    for (const [name, colours] of Object.entries(palettes)) {
        const [all, ...blind] = least_distance(colours);
        console.log(`${name}: ${colours.length} colours, least distance in OKLab ${all.toFixed(3)}, red-blind ${blind[0].toFixed(3)}, green-blind ${blind[1].toFixed(3)}`);
        // 0.02 is just noticeable side by side; a curve and its legend are apart.
        assert.ok(colours.length >= 12 && all > 0.12 && Math.min(...blind) > 0.06, `${name}: ${all}, ${blind}`);
    }
});

test("the legend of materials is its own after that of regions, where a name is in both", async () => {
    await open_run(api.add_run({ ...study, name: "same-names", transfer_times: [1], scene: { ...study.scene, section: { regions: [
        { ...study.scene.section.regions[0], material: "column" }, { ...study.scene.section.regions[1], material: "base" }] } } },
        { began: Date.now() - 60000 }).id);
    await until("soil", async () => (await canvas_facts(page)).share > 0.05);
    const legend = () => page.evaluate(() => [...document.querySelectorAll("#view-regions li")].map((one) =>
        [one.textContent.trim(), getComputedStyle(one.querySelector(".chip")).backgroundColor]));
    await page.selectOption("#view-field", "region");
    const regions = await legend();
    await page.selectOption("#view-field", "material");
    const materials = await legend();
    assert.deepEqual(regions.map(([name]) => name), ["base", "column"]);
    assert.deepEqual(materials.map(([name]) => name), ["column", "base"]);
    assert.deepEqual(materials.map(([, colour]) => colour), regions.map(([, colour]) => colour), "colours go by place, as on the canvas");
});

test("window, plateau, thresholds and firings of triggers are drawn where they belong", async () => {
    await open_run(variants_run());
    assert.deepEqual(await page.locator("#runout-plot .band title").allTextContents(),
                     ["window: 0.8 to 1.2", "plateau, at least 75 % of the largest: 0.5 to 1.5"]);
    await until("panels", async () => (await page.locator("#telemetry-plots figure").count()) === 8);
    const levels = (title) => page.locator(`#telemetry-plots figure:has-text("${title}") .level-text`).allTextContents();
    assert.deepEqual(await levels("Crest displacement"), ["window, lower edge 0.2"]);
    assert.deepEqual(await levels("Jacobian ratio"), ["window, upper edge 0.9"]);
    assert.deepEqual(await levels("Deviatoric strain"), ["strained 0.05"]);
    assert.deepEqual(await levels("Kinetic energy"), []);
    assert.deepEqual(await page.locator("#telemetry-plots figure:nth-child(1) .event-text").allTextContents(), ["strained", "window"]);
    assert.equal(await page.locator("#trigger-rows tr").count(), 3);
    assert.match(await text_of("#trigger-rows tr:nth-child(3)"), /edges.*bisect.*fired.*5 runs instead of 40/s);
    const x_of = (path) => parseFloat(path.match(/^M([\d.]+)/)[1]);
    const fired = await page.locator("#telemetry-plots figure:nth-child(1) .event.fired").evaluateAll((all) => all.map((one) => one.getAttribute("d")));
    assert.equal(fired.length, 2);
    assert.ok(x_of(fired[0]) < x_of(fired[1]), "0.75 s is left of 1 s");
});

test("thresholds are read from conditions, formulas are not", async () => {
    await open_run(variants_run());
    const read = await page.evaluate(async () => {
        const { thresholds_in } = await import("/static/triggers.js");
        return ["jacobian_least_avg < 0.97 and not (time < 1)", "growth(kinetic_energy, 0.2) > 5 or epsilon_q_avg >= 2e-1",
                "0.9 > a", "2 * a > 3", "a > 3 * b", "a < -.5", "a < b", "max(a, b) < 3"]
            .map((text) => thresholds_in(text).map(({ field, y }) => `${field} ${y}`).join());
    });
    assert.deepEqual(read, ["jacobian_least_avg 0.97", "epsilon_q_avg 0.2", "a 0.9", "", "", "a -0.5", "", ""]);
});

test("error against run time: a marker per point, CPU time per phase", async () => {
    await open_run(variants_run());
    await until("markers", async () => (await page.locator("#cost-runout .marker").count()) >= 14);
    assert.equal(await page.locator("#cost-share svg.plot > .marker").count(), 14);
    assert.match(await text_of("#cost-runout-title"), /no error estimate/);
    const sums = await page.locator("#cost-rows tr:last-child td").allTextContents();
    assert.deepEqual(sums.slice(0, 4), ["16", "0", "14", "21 s"]); // 14 attempts of 1.5 s
    await page.focus("#cost-share svg.plot");
    await page.keyboard.press("Home");
    assert.match(await text_of("#cost-share .readout"), /^CPU = 7.5 s: softened, t_T = 0.25 s 0.0335/);
});

test("every number leads to its files, hashes and settings", async () => {
    await open_run(variants_run());
    await until("rows", async () => (await page.locator("#runout-rows tr").count()) === 16);
    await page.click('#runout-rows tr[data-key="1/softened"] [data-column="numerical_share"]');
    await page.waitForSelector("#provenance[open] .step");
    assert.match(await text_of("#provenance-title"), /numerical share of the released energy: 0.041/);
    assert.match(await text_of("#provenance-where"), /t_T = 1 s, softened. “energy.numerical.share” in result.json of task run-\d+-task-/);
    assert.deepEqual(await page.locator("#provenance .step h3").allTextContents(),
                     ["mpm_solver, t_T = 1 s, softened", "transfer_tool, t_T = 1 s", "fem_solver"]);
    const chain = await text_of("#provenance-chain");
    for (const part of [/trigger window \(window\)/, /"crest_dx": 0.21, "step": 160/, /variant sets.*softening=1/s, /version0.1.0/, /first of its kind/,
                        /mpm_solver scene.completed.json --input particles.vtkhdf --threads 1 --output again/]) {
        assert.match(chain, part);
    }
    await page.click("#provenance .step:first-child summary, #provenance .step summary >> nth=0");
    const links = await page.locator("#provenance a").evaluateAll((all) => all.map((one) => one.getAttribute("href")));
    assert.ok(links.length >= 6 && links.every((href) => /^\/v1\/artifacts\/[0-9a-f]{64}$/.test(href)), links.join("\n"));
    await page.screenshot({ path: `${build_folder}/screenshots/page_provenance.png` });
    await page.keyboard.press("Escape");
    await page.focus('#runout-rows tr[data-key="1/softened"] td:last-child button');
    await page.keyboard.press("Enter");
    await page.waitForSelector("#provenance[open] .step");
    await page.keyboard.press("Escape");
});

test("a transfer belongs to the FEM that it was taken from, under any name", async () => {
    await open_run(variants_run());
    const found = await page.evaluate(async () => {
        const { fem_of } = await import("/static/provenance.js");
        const fem = (id, variant) => ({ id, phase: "fem_solver", variant });
        const of = (variant, told, tasks = [fem("f1", "a"), fem("f2", "b")]) => fem_of({ tasks }, { id: "t", variant }, new Map(told)) ?? "none";
        return [of("a", [["t", "f2"]]), of("b", []), of("c", []), of("c", [], [fem("f1", "a")])];
    });
    assert.deepEqual(found, ["f2", "f2", "none", "f1"], "as the server tells; of an earlier one by name, or the only one");
});

test("the axis of the cost says runout again when the next run has no error", async () => {
    const axis = () => page.locator("#cost-runout svg.plot").getAttribute("aria-label");
    await open_run(api.add_run(drawn, { began: Date.now() - 60000 }).id);
    await until("its error", async () => /error estimate of the runout \[m\]/.test(await axis()));
    await page.evaluate((id) => { location.hash = `#/runs/${id}`; }, variants_run()); // the same page, another run
    await until("its runout", async () => /runout from the toe \[m\]/.test(await axis()));
});

test("telemetry of a finished variant is its own; a running one among several says why it is not there", async () => {
    await open_run(variants_run());
    await page.selectOption("#telemetry-source", { label: "MPM from t_T = 2 s, not-softened" });
    await until("curves", async () => (await page.locator("#telemetry-plots .curve").count()) > 8);
    await open_run(api.add_run(two_variants, { pace: 600, began: Date.now() - 400000 }).id);
    await until("its sources", async () => (await page.locator("#telemetry-source option").count()) > 0);
    const running = await page.locator("#telemetry-source option").evaluateAll((all) => all.at(-1).value);
    await page.selectOption("#telemetry-source", running);
    await until("the reason", async () => /variants apart only when/.test(await text_of("#telemetry-message")));
});

test("the database is read as tables: pages, filter, sorting, CSV, addresses", async () => {
    const wanted = variants_run();
    const before_these = api.runs.length;
    for (let i = 0; i < 60; i += 1) api.add_run({ ...study, name: `many-${i}`, transfer_times: [1] }, { began: Date.now() - 60000 });
    await page.click('a[href="#/database"]');
    const rows = () => page.locator("#database-table tbody tr").count();
    const count = () => text_of("#database-table p");
    await until("fifty rows", async () => (await rows()) === 50);
    const all = before_these + 60;
    assert.equal(await count(), `Rows 1 to 50 of ${all}.`);
    await page.click("#database-table >> text=Next ▸");
    assert.equal(await rows(), all - 50);
    await page.fill("#database-table input", "state=partial softened");
    assert.equal(await count(), `Rows 1 to 1 of 1, filtered from ${all}.`);
    await page.fill("#database-table input", "");
    await page.click("#database-table thead button:has-text('name')");
    assert.match(await text_of("#database-table tbody tr:first-child"), /fake-column/);
    assert.equal(await page.getAttribute("#database-table thead th:nth-child(2)", "aria-sort"), "ascending");

    await page.click("[data-table=attempts]");
    await page.selectOption("#database-run", wanted);
    await until("its attempts", async () => page.url().endsWith(`#/database/attempts/${wanted}`) && /of 24\.$/.test(await count()));
    await page.click("[data-table=results]");
    await until("its results", async () => /of 16\.$/.test(await count()));
    assert.equal(await page.getAttribute("#database-csv", "href"), `/v1/runs/${wanted}/results?format=csv`);
    await page.fill("#database-table input", "variant=softened");
    const waiting = page.waitForEvent("download");
    await page.click("#database-table >> text=CSV of the filtered rows");
    const csv = readFileSync(await (await waiting).path(), "utf8").trim().split("\r\n");
    assert.equal(csv.length, 17, "softened is in not-softened too");
    assert.match(csv[0], /^transfer_time,variant,state,runout,/);
    await page.click("[data-table=triggers]");
    await until("its firings", async () => (await rows()) === 4);
    await page.click("[data-table=tasks]");
    await until("its tasks", async () => (await rows()) === 26);
    await page.click("[data-table=events]");
    await until("events", async () => (await rows()) === 50);
    await page.screenshot({ path: `${build_folder}/screenshots/page_database.png` });

    const worker = { run: wanted, phase: "mpm_solver", label: "mpm_4.0", variant: "", since: "2026-11-23T02:00:00.000Z", attempt: 1, pid: null,
                     cores: 1, memory_MB: 800, cpu_seconds: null, memory_used_MB: null, message: "" };
    api.workers = { executor: "slurm", slots: 40, slots_used: 2, memory_MB: null, memory_asked_MB: 1600, limits: { mpm_solver: 30 },
                    queue: { ready: 7, retry_wait: 0, blocked: 12 }, slurm: { states: { RUNNING: 1, PENDING: 1 }, reasons: { Priority: 1 } },
                    workers: [{ ...worker, task: "1", state: "running", host: "node-3", job: "17", job_state: "RUNNING", job_reason: null, progress: 0.4 },
                              { ...worker, task: "2", state: "starting", host: null, job: "18", job_state: "PENDING", job_reason: "Priority", progress: 0 }] };
    await page.click("[data-table=workers]");
    await until("both", async () => (await rows()) === 2);
    assert.equal(await text_of("#database-slots"), "Slurm: 2 of 40 cores taken; 7 tasks ready; 12 wait for others; at most 30 mpm_solver at once; " +
                                                   "jobs: 1 RUNNING, 1 PENDING; 1 Priority.");
    await page.screenshot({ path: `${build_folder}/screenshots/page_workers.png` });
    api.workers.workers.pop();
    api.add_run(study, { began: Date.now() });
    await until("one without being asked", async () => (await rows()) === 1);

    api.most_per_page = 10;
    await page.click("[data-table=runs]");
    await until("forty of them", async () => /of 40; the server has more/.test(await count()));
    await page.click("#database-more");
    await until("all", async () => (await count()).endsWith(`of ${all + 1}.`));
    api.most_per_page = 500;
    await page.fill("#database-table input", `id=${wanted}`);
    await page.click(`#database-table a[href="#/runs/${wanted}"]`);
    await page.waitForSelector("#run:not([hidden])");
    api.runs.splice(before_these);
});

test("points are coloured by pore pressure ratio, pore pressure with suction, and material", async () => {
    await open_run("run-1");
    await until("soil", async () => (await canvas_facts(page)).share > 0.05);
    assert.deepEqual(await page.locator("#view-field option").allTextContents(),
                     ["velocity (magnitude)", "deviatoric strain ε_q", "region", "pore pressure ratio r_u", "pore pressure u", "plastic strain ε_q", "material"]);
    await page.selectOption("#view-field", "pore_pressure");
    assert.match(await text_of("#view-range"), /pore pressure u \[kPa\], -5\d+ to 14\d+/);
    await page.selectOption("#view-field", "material");
    assert.deepEqual((await page.locator("#view-regions li").allTextContents()).map((name) => name.trim()), ["rock", "sand"]);
    await page.selectOption("#view-source", { label: "FEM mesh" });
    await until("elements", async () => (await text_of("#view-count")) === "800 elements");
    await page.selectOption("#view-field", "r_u");
    assert.match(await text_of("#view-range"), /r_u \[–\], 0 to 0\.\d+/);
});

test("when the server goes away the page says so, keeps what it shows, and recovers", async () => {
    await open_run("run-1");
    await until("markers", async () => (await markers()) === 7);
    const port = Number(new URL(url).port);
    await api.close();
    await until("the notice", async () => /Connection lost, retrying/.test(await text_of("#connection")));
    assert.equal(await markers(), 7);
    await screenshot(page, "page_connection_lost");
    await page.click("#run-list li:last-child a");
    assert.equal(await page.isVisible("#run"), true);
    await api.open(port);
    await until("live again", async () => (await text_of("#connection")) === "Live");
    api.add_run({ ...study, name: "after-the-break" });
    await until("the new run in the list", async () => /after-the-break/.test(await text_of("#run-list")));
});

test("a run that does not exist is said to be missing", async () => {
    await page.goto("about:blank");
    await page.goto(`${url}/#/runs/nowhere`);
    await page.waitForSelector("#missing:not([hidden])");
});

test("a truncated snapshot is refused, never drawn wrong", async () => {
    const refused = await page.evaluate(async () => {
        const { decode_points } = await import("/static/api.js");
        const header = '{"time":0,"count":4,"fields":["x","y"]}\n';
        const whole = new Uint8Array(header.length + 32);
        whole.set(new TextEncoder().encode(header));
        const verdict = (bytes) => {
            try {
                return `${decode_points(bytes.slice().buffer).count} points`;
            } catch (fault) {
                return fault.message;
            }
        };
        return [verdict(whole), verdict(whole.subarray(0, 50)), verdict(new Uint8Array(8))];
    });
    assert.equal(refused[0], "4 points");
    assert.match(refused[1], /50 bytes instead of 72/);
    assert.match(refused[2], /no header/);
});

test("every control has a name, and the keyboard reaches it", async () => {
    await open_run("run-1");
    await page.click("#task-rows tr:nth-child(2) button");
    await until("panels", async () => (await page.locator("#telemetry-plots figure").count()) === 8);
    const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, a, canvas, svg.plot, progress")]
        .filter((control) => control.checkVisibility())
        .filter((control) => !(control.getAttribute("aria-label") || control.labels?.length ||
                               control.textContent.trim() && control.tagName !== "SELECT" || control.title))
        .map((control) => control.outerHTML.slice(0, 120)));
    assert.deepEqual(nameless, []);
    await page.evaluate(() => {
        window.reached = new Set();
        document.addEventListener("focusin", ({ target }) => window.reached.add(target.id || target.className.baseVal || target.className));
        document.body.focus();
    });
    for (let i = 0; i < 220; i += 1) await page.keyboard.press("Tab");
    const reached = new Set(await page.evaluate(() => [...window.reached]));
    for (const id of ["theme", "plot", "view", "view-time", "view-field", "runout-csv", "telemetry-source", "link", "log"]) {
        assert.ok(reached.has(id), `${id} is reached by Tab; reached: ${[...reached]}`);
    }
});

test("text has a contrast of 4.5 and graphics of 3 in light and dark", async () => {
    for (const scheme of ["light", "dark"]) {
        while ((await page.getAttribute("html", "data-theme")) !== scheme) await page.click("#theme");
        const ratios = await page.evaluate(() => {
            const style = getComputedStyle(document.documentElement);
            const luminance = (name) => {
                const hex = style.getPropertyValue(`--${name}`).trim();
                const parts = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255)
                    .map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
                return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
            };
            const contrast = (a, b) => {
                const [high, low] = [luminance(a), luminance(b)].sort((p, q) => q - p);
                return (high + 0.05) / (low + 0.05);
            };
            const text = [["text", "ground"], ["text", "card"], ["muted", "ground"], ["muted", "card"], ["link", "card"],
                          ["on-primary", "primary"], ["muted", "canvas"], ["fired", "card"],
                          ["warn", "card"], ...["good", "bad", "warn", "busy", "off", "calm"].map((name) => [name, `${name}-back`])];
            const graphics = [...Array.from({ length: 12 }, (_, i) => `series-${i}`), "focus", "axis", "event",
                              "window", "plateau"].map((name) => [name, "card"]);
            return [...text.map(([a, b]) => [a, b, contrast(a, b), 4.5]), ...graphics.map(([a, b]) => [a, b, contrast(a, b), 3])];
        });
        for (const [front, back, reached, least] of ratios) {
            assert.ok(reached >= least, `${scheme}: ${front} on ${back} reaches ${reached.toFixed(2)}, ${least} is needed`);
        }
        console.log(`${scheme}: least contrast ${Math.min(...ratios.map((row) => row[2] / row[3])).toFixed(2)} of what is needed`);
    }
});

test("it fits narrow and wide windows, light and dark", async () => {
    const half_way = api.add_run({ ...two_variants, name: "half-way", title: "A run half-way" }, { pace: 600, began: Date.now() - 420000 });
    for (const [theme, width] of [["light", 1400], ["dark", 1400], ["light", 390], ["dark", 390], ["light", 2200]]) {
        await page.setViewportSize({ width, height: 900 });
        await open_run(half_way.id);
        while ((await page.getAttribute("html", "data-theme")) !== theme) await page.click("#theme");
        await page.click("#task-rows tr:nth-child(2) button");
        await until("soil", async () => (await canvas_facts(page)).share > 0.02);
        await page.waitForTimeout(300); // transitions
        const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
        assert.ok(overflow <= 0, `${width} px: ${overflow} px wider than the window`);
        await screenshot(page, `page_${theme}_${width}`);
    }
});

test("words of the page lead to their line in the glossary", async () => {
    await open_run(api.add_run({ ...two_variants, name: "worded" }, { began: Date.now() - 20000, pace: 1, flagged: some_flagged, entangles: 2.1 }).id);
    await until("a flag that is a link", async () => (await page.locator("#reasons a.term").count()) > 0);
    const links = await page.locator("a.term").evaluateAll((all) => all.map((link) => [link.textContent, link.hash, link.title]));
    for (const word of ["t_T", "overlap", "numerical share", "repeats", "entangled", "window", "rest"]) assert.ok(links.some(([text]) => text.includes(word)), `${word} in ${links}`);
    assert.deepEqual(links.filter(([, , title]) => title === ""), [], "each says its line");
    await page.click("#reasons a.term");
    await until("the glossary", () => page.isVisible("#glossary"));
    await until("its line", async () => (await page.locator("#glossary-terms .chosen").count()) === 1);
    assert.ok(await page.isHidden("#run"));
    assert.ok(await page.locator("#glossary-terms > div").count() <= 60);
    await screenshot(page, "glossary");
    await page.goBack();
    await until("the run", () => page.isVisible("#run"));
});

test("nothing failed inside the page", () => {
    assert.deepEqual(browser.complaints, []);
    assert.deepEqual(browser.foreign, []);
});
