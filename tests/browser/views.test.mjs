// What the page shows of snapshots, against a stand-in server whose soil is a formula: contours, vectors, water, profiles. The formulas
// say what must come out.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { canvas_facts, open_browser, open_run as open_run_of, screenshot, until } from "./browser.mjs";
import { FakeApi, still_moving, study, twelve_variants } from "./fake_api.mjs";

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

const text_of = (selector) => page.textContent(selector);

/// A new run of the column begins with its own picture and time; fields and scales stay as a person chose them.
async function open_run(id = api.add_run(study, { began: Date.now() - 60000 }).id) {
    await open_run_of(page, url, id);
    await until("soil", async () => (await canvas_facts(page)).share > 0.02);
}

async function open_mesh(field) {
    await open_run();
    await page.selectOption("#view-source", { label: "FEM mesh" });
    await until("elements", async () => (await text_of("#view-count")) === "800 elements");
    await page.selectOption("#view-field", field);
    await until("all snapshots are known", async () => /all 25 snapshots/.test(await text_of("#view-scale-note")));
}

/// What the text downloaded by a click says.
async function downloaded(selector) {
    const [file] = await Promise.all([page.waitForEvent("download"), page.click(selector)]);
    return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

test("contours of nodal values: bands of few colours; soil without a value is grey, and the legend says so", async () => {
    await open_mesh("displacement");
    await page.selectOption("#view-scale-of", "this");
    await page.uncheck("#view-water");
    await until("twelve bands", async () => (await canvas_facts(page)).colours < 400);
    await page.selectOption("#view-shading", "elements");
    await until("a colour per element", async () => (await canvas_facts(page)).colours > 100);
    await page.selectOption("#view-shading", "contours");
    assert.ok(await page.isHidden("#view-none"), "every node has a displacement");
    await page.selectOption("#view-field", "r_u");
    assert.ok(await page.isVisible("#view-none"));
    assert.match(await text_of("#view-scale-note"), /none where the soil is dry/);
    await screenshot(page, "views_contours_r_u");
    await page.selectOption("#view-field", "sigma_v");
    assert.match(await text_of("#view-range"), /σ′_v \[kPa\], 0 to 300/);
    assert.match(await text_of("#view-scale-note"), /Shown now: 0 to 300 kPa/);
    await page.selectOption("#view-scale-of", "all");
});

test("a fixed range is that of all snapshots, another one says of which", async () => {
    await open_mesh("displacement");
    const fixed = await text_of("#view-range");
    await page.focus("#view-time");
    await page.keyboard.press("Home");
    await until("the first", async () => (await text_of("#view-now")).startsWith("t = 0 s"));
    assert.equal(await text_of("#view-range"), fixed);
    await page.selectOption("#view-scale-of", "this");
    assert.match(await text_of("#view-range"), /0 to 1$/, "nothing has moved yet");
    assert.match(await text_of("#view-scale-note"), /this snapshot: in another one the colours mean other values.*Shown now: 0 to 0 m/);
    await page.selectOption("#view-scale-of", "all");
});

test("vectors tell their length, and that there are none where nothing moved", async () => {
    await open_mesh("displacement");
    await page.selectOption("#view-field", "region");
    await page.check("#view-vectors");
    assert.match(await text_of("#view-vectors-note"), /Longest vector \d.* m/);
    await screenshot(page, "views_vectors");
    await page.focus("#view-time");
    await page.keyboard.press("Home");
    await until("nothing moved", async () => /Nothing has moved/.test(await text_of("#view-vectors-note")));
    await page.uncheck("#view-vectors");
});

test("a profile is what the formula says, in the figure and in its CSV; by numbers and by two clicks", async () => {
    await open_mesh("sigma_v");
    await page.focus("#view-time");
    await page.keyboard.press("Home"); // not deformed: sigma_v = 15 (20 - y) kPa
    await until("the first", async () => (await text_of("#view-now")).startsWith("t = 0 s"));
    for (const [id, value] of [["x1", 5], ["y1", 24], ["x2", 5], ["y2", 0]]) await page.fill(`#cut-${id}`, String(value));
    await page.waitForSelector("#profile:not([hidden]) svg.plot > path.curve");
    const { name, bytes } = await downloaded("#profile-csv");
    assert.equal(name, "profile_sigma_v_0s.csv");
    const [about, head, ...lines] = bytes.toString().trim().split("\r\n");
    assert.match(about, /σ′_v at 0 s, A column made of formulas, FEM mesh/);
    assert.equal(head, '"distance [m]","x [m]","y [m]","vertical effective stress σ′_v [kPa]"');
    const rows = lines.map((line) => line.split(","));
    assert.equal(rows.length, 241);
    for (const [distance, x, y, value] of rows) {
        assert.ok(Math.abs(24 - y - distance) < 1e-5 && Number(x) === 5);
        if (Number(y) > 20) assert.equal(value, "", "no soil is no number");
        else assert.ok(Math.abs(value - 15 * (20 - y)) < 0.01, `${value} kPa at y = ${y} m`);
    }
    await page.selectOption("#view-field", "r_u");
    assert.match(await text_of("#profile-title"), /r_u along A–B at 0 s/);

    await page.click("#cut-clear");
    assert.ok(await page.isHidden("#profile"));
    await page.selectOption("#view-field", "sigma_v");
    await page.click("#cut-pick");
    const { width, height } = await page.locator("#view").boundingBox();
    await page.locator("#view").click({ position: { x: 0.35 * width, y: 0.5 * height } });
    await page.locator("#view").click({ position: { x: 0.7 * width, y: 0.6 * height } });
    await page.waitForSelector("#profile:not([hidden]) svg.plot > path.curve");
    assert.ok(Number(await page.inputValue("#cut-x2")) > Number(await page.inputValue("#cut-x1")));
    await screenshot(page, "views_profile");
    await page.selectOption("#view-field", "region");
    assert.ok(await page.isHidden("#profile"));
    assert.match(await text_of("#cut-message"), /has no profile/);
});

test("a profile through points takes the next point, and leaves gaps where there is none", async () => {
    await open_run();
    await page.selectOption("#view-field", "pore_pressure");
    for (const [id, value] of [["x1", -5], ["y1", 1], ["x2", 40], ["y2", 1]]) await page.fill(`#cut-${id}`, String(value));
    await page.waitForSelector("#profile:not([hidden]) svg.plot > path.curve");
    const rows = (await downloaded("#profile-csv")).bytes.toString().trim().split("\r\n").slice(2).map((line) => line.split(","));
    assert.ok(rows.filter(([, x]) => Number(x) < -1 || Number(x) > 30).every(([, , , value]) => value === ""));
    const inside = rows.filter(([, x]) => Number(x) > 1 && Number(x) < 9);
    assert.ok(inside.every(([, , , value]) => Number(value) > 100 && Number(value) <= 140), inside.join(" | "));
});

test("gauges stand beside the runout, with a mark that moves along; a mesh has none", async () => {
    await open_run();
    await until("two curves", async () => (await page.locator("#gauge-depth svg.plot > path.curve").count()) === 2);
    assert.match(await text_of("#gauges-note"), /Recorded to 12 s/);
    const mark = () => page.locator("#gauge-depth .now").evaluate((line) => Number(/^M([\d.]+)/.exec(line.getAttribute("d"))?.[1]));
    const end = await mark();
    await page.focus("#view-time");
    await page.keyboard.press("Home");
    await until("the first", async () => (await text_of("#view-now")).startsWith("t = 0 s"));
    const begin = await mark();
    for (let i = 0; i < 12; i += 1) await page.keyboard.press("ArrowRight");
    await until("half-way", async () => (await text_of("#view-now")).startsWith("t = 6 s"));
    assert.ok(Math.abs((await mark()) - (begin + end) / 2) < 1, `${begin} ${await mark()} ${end}`);
    assert.deepEqual(await page.locator("#gauge-depth .legend li").allTextContents(), [" road (x = 14 m)", " house (x = 18 m)"]);
    await screenshot(page, "views_gauges");
    await page.selectOption("#view-source", { label: "FEM mesh" });
    await until("no gauges", () => page.isHidden("#gauges"));
});

test("a variant's picture shows the scene as that variant has it", async () => {
    const moved = { ...study, name: "moved", overrides: ["/mpm/gauges/1/x=19"],
                    variants: [{ name: "as-sent", overrides: [] }, { name: "road-moved", overrides: ["/mpm/gauges/0/x=15", '/mpm/gauges/-={"name": "school", "x": 20}'] }] };
    await open_run(api.add_run(moved, { began: Date.now() - 60000 }).id);
    const legend = () => page.locator("#gauge-depth .legend li").allTextContents();
    await page.selectOption("#view-source", { label: "MPM from t_T = 2 s, as-sent" });
    await until("the study's gauges", async () => (await legend()).join() === " road (x = 14 m), house (x = 19 m)");
    await page.selectOption("#view-source", { label: "MPM from t_T = 2 s, road-moved" });
    await until("the variant's", async () => (await legend()).join() === " road (x = 15 m), house (x = 19 m), school (x = 20 m)");
});

test("the time is that of the picture that is seen while another one is on its way", async () => {
    let let_go;
    const gate = new Promise((resume) => { let_go = resume; });
    await page.route(/snapshot_00012/, async (route) => {
        await gate;
        await route.continue();
    });
    await open_run();
    await until("the last", async () => (await text_of("#view-now")) === "t = 12 s  (25 of 25)");
    const [seen, mark] = [(await canvas_facts(page)).sum, await page.getAttribute("#gauge-depth .now", "d")];
    await page.focus("#view-time");
    for (let i = 0; i < 12; i += 1) await page.keyboard.press("ArrowLeft");
    await until("what is wanted", async () => (await text_of("#view-now")).endsWith(", number 13 is on its way"));
    const now = Number(/^t = ([\d.]+) s/.exec(await text_of("#view-now"))[1]);
    assert.ok(now > 6, `${now} s`);
    if (now === 12) assert.deepEqual([(await canvas_facts(page)).sum, await page.getAttribute("#gauge-depth .now", "d")], [seen, mark]);
    let_go();
    await until("it has come", async () => (await text_of("#view-now")) === "t = 6 s  (13 of 25)");
    assert.notEqual(await page.getAttribute("#gauge-depth .now", "d"), mark);
    await until("another picture", async () => (await canvas_facts(page)).sum !== seen);
    await page.unroute(/snapshot_00012/);
});

test("points are coloured by velocity, material, r_u and plastic strain, each with its legend", async () => {
    await open_run();
    for (const [field, legend] of [["speed", /velocity \(magnitude\) \[m\/s\], 0 to/], ["r_u", /r_u \[–\], 0 to/], ["epsilon_q_plastic", /plastic strain ε_q \[–\], 0 to/]]) {
        await page.selectOption("#view-field", field);
        assert.match(await text_of("#view-range"), legend);
    }
    await page.selectOption("#view-field", "material");
    assert.ok(await page.isVisible("#view-regions"));
    await page.selectOption("#view-field", "epsilon_q");
});

test("two runs stand side by side on one time, with one scale; each says where it is and whether it came to rest", async () => {
    const other = api.add_run({ ...study, name: "other", title: "Another column" }, { began: Date.now() - 60000, flagged: { 0.5: [still_moving] }, points: 2000 });
    await open_run();
    await page.selectOption("#view-source", { label: "MPM from t_T = 0.5 s" });
    await page.click("#view-compare");
    await page.waitForSelector("#compare:not([hidden])");
    await until("both pictures", async () => (await canvas_facts(page, "compare-0")).share > 0.02 && (await canvas_facts(page, "compare-1")).share > 0.02);
    await page.selectOption("#compare-run-1", other.id);
    await until("the other run's", async () => page.url().includes(`/${other.id}-task-`));
    await page.selectOption("#compare-source-1", { label: "MPM from t_T = 0.5 s" });
    await until("what it says", async () => /12 s since its transfer at t_T = 0.5 s; at its end: moving, 12 % in motion/.test(await text_of("#compare-says-1")));
    assert.match(await text_of("#compare-says-0"), /12 s since its transfer at t_T = 0.5 s; at its end: at rest/);
    const before = (await canvas_facts(page, "compare-1")).sum;
    await page.focus("#compare-time");
    for (let i = 0; i < 20; i += 1) await page.keyboard.press("ArrowLeft");
    await until("an earlier time", async () => (await text_of("#compare-now")) === "t = 2 s");
    for (const side of [0, 1]) await until("its time", async () => (await text_of(`#compare-says-${side}`)).startsWith("2 s "));
    await until("another picture", async () => (await canvas_facts(page, "compare-1")).sum !== before);
    await page.focus("#compare-0");
    await page.keyboard.press("+");
    const spans = () => page.evaluate(() => [0, 1].map((i) => document.getElementById(`compare-${i}`)).map(({ width, height }) => `${width} ${height}`));
    assert.equal(new Set(await spans()).size, 1, "both have one size");
    await screenshot(page, "views_compare");
    await page.click("#compare-play");
    await until("the end", async () => (await text_of("#compare-now")) === "t = 12 s" && /Play/.test(await text_of("#compare-play")));
    await page.selectOption("#compare-source-1", { label: "FEM mesh" });
    await until("different clocks", async () => /different clocks/.test(await text_of("#compare-note")));
    await page.goto(`${url}/#/compare/nothing`);
    await page.waitForSelector("#missing:not([hidden])");
});

test("results stand against a parameter, one colour and shape per variant; a variant without that number is named", async () => {
    const variants = [...twelve_variants.variants, { name: "strange", overrides: ["/materials/sand/law/c_kPa=null"] }];
    const run = api.add_run({ ...twelve_variants, name: "parameter", variants, transfer_times: [0.5, 1] }, { began: Date.now() - 60000, breaks: [] });
    await open_run(run.id);
    await until("markers", async () => (await page.locator("#runout-plot svg.plot > .marker").count()) === 26);
    assert.deepEqual(await page.locator("#runout-abscissa option").allTextContents(), ["transfer time", "/materials/sand/law/c_kPa"]);
    await page.selectOption("#runout-abscissa", "/materials/sand/law/c_kPa");
    await until("24 markers", async () => (await page.locator("#runout-plot svg.plot > .marker").count()) === 24);
    assert.deepEqual(await page.locator("#runout-plot .label").allTextContents(), ["/materials/sand/law/c_kPa", "runout from the toe [m]"]);
    assert.match(await text_of("#runout-note"), /neither they nor the scene that was sent give \/materials\/sand\/law\/c_kPa as a number: strange\./);
    const looks = await page.$$eval("#runout-plot svg.plot > .marker", (all) => all.map((one) =>
        ({ look: `${getComputedStyle(one).fill} ${one.getAttribute("d")}`, x: /translate\(([\d.]+)/.exec(one.getAttribute("transform"))[1] })));
    assert.equal(new Set(looks.map(({ look }) => look)).size, 12);
    assert.equal(new Set(looks.map(({ x }) => x)).size, 12, "one place per value, both transfer times above each other");
    await page.focus("#runout-plot svg.plot");
    await page.keyboard.press("Home");
    assert.match(await text_of("#runout-plot .readout"), /^c_kPa = 10: strength_x_0.70, t_T = 0.5 s /);
    await screenshot(page, "views_parameter");
    await page.selectOption("#runout-abscissa", "");
    await until("the curves", async () => (await page.locator("#runout-plot svg.plot > .marker").count()) === 26);
    await page.keyboard.press("Home");
    await open_run();
    assert.ok(await page.isHidden("#runout-abscissa-label"), "a study without variants has no parameters");
});

/// Width, height and how many colours a picture has that is looked at without the page; of a film, its first and last picture.
async function looked_at(kind, bytes) {
    const other = await page.context().newPage();
    const facts = await other.evaluate(async ([type, text]) => {
        const seen = (source, width, height) => {
            const canvas = Object.assign(document.createElement("canvas"), { width, height });
            const context = canvas.getContext("2d");
            context.drawImage(source, 0, 0);
            const pixels = new Uint32Array(context.getImageData(0, 0, width, height).data.buffer);
            return { width, height, colours: new Set(pixels).size, sum: pixels.reduce((sum, each, i) => (sum + each * (i % 997)) % 4294967291, 0) };
        };
        const address = `data:${type};base64,${text}`;
        if (type.startsWith("image")) {
            const image = new Image();
            image.src = address;
            await image.decode();
            return seen(image, image.naturalWidth, image.naturalHeight);
        }
        const video = Object.assign(document.createElement("video"), { muted: true, src: address });
        await new Promise((resume, give_up) => Object.assign(video, { onloadeddata: resume, onerror: () => give_up(video.error) }));
        const first = seen(video, video.videoWidth, video.videoHeight);
        await video.play();
        await new Promise((resume) => (video.onended = resume));
        return { first, last: seen(video, video.videoWidth, video.videoHeight), length: video.currentTime };
    }, [kind, bytes.toString("base64")]);
    await other.close();
    return facts;
}

test("a variant without a transfer is among the reasons of the verdict", async () => {
    const without = [{ variant: "strength_x_1.25", fem_task: "r-0", state: "not_reached", stood: true, reason: "window: the FEM ended at 25 s" }];
    const run = api.add_run({ ...twelve_variants, name: "without", without }, { began: Date.now() - 60000, breaks: [] });
    await open_run(run.id);
    await until("the list", async () => (await page.locator("#reasons li").count()) === 1);
    assert.equal(await text_of("#reasons"), "no transfer No transfer from strength_x_1.25, so there is no runout: window: the FEM ended at 25 s. The dam may stand; then nothing runs out.");
    const other = api.add_run({ ...twelve_variants, name: "with" }, { began: Date.now() - 60000, breaks: [] });
    await open_run(other.id);
    await until("no list", async () => (await page.locator("#reasons li").count()) === 0 && (await text_of("#verdict")) === "Verdict: usable");
    assert.ok(await page.isVisible("#runout-plot"));
    const same = api.add_run({ ...twelve_variants, name: "same", same: [["a", "b"]] }, { began: Date.now() - 60000, breaks: [] });
    await open_run(same.id);
    await until("the list", async () => (await text_of("#reasons")) === "same results The variants a, b have identical results: the entries that differ had no effect.");
    const none = api.add_run({ ...twelve_variants, name: "none", variants: [], transfer_times: [], without: [{ ...without[0], variant: "" }] }, { began: Date.now() - 60000, breaks: [] });
    await open_run(none.id);
    await until("the list", async () => (await page.locator("#reasons li").count()) === 1);
    assert.match(await text_of("#reasons"), /^no transfer No transfer, so there is no runout: /);
    assert.ok(await page.isHidden("#runout-plot") && await page.isHidden("#runout-table"), "empty axes say nothing");
});

test("figures are saved as SVG that needs no style sheet, and as PNG", async () => {
    await open_run();
    await page.selectOption("#runout-measure", "runout"); // the run before had none
    const figure = await downloaded("#runout-plot .under-plot button:has-text('SVG')");
    assert.equal(figure.name, "Runout_A_column_made_of_formulas.svg");
    const text = figure.bytes.toString();
    for (const part of ["transfer time t_T [s]", "runout from the toe [m]", "99 % of the mobile soil", "failed", "A column made of formulas"]) {
        assert.ok(text.includes(part), `${part} is in it`);
    }
    assert.ok(!text.includes("var(--"), "all colours are colours");
    const drawn = await looked_at("image/svg+xml", figure.bytes);
    const png = await downloaded("#runout-plot .under-plot button:has-text('PNG')");
    const seen = await looked_at("image/png", png.bytes);
    assert.deepEqual([seen.width, seen.height], [2 * drawn.width, 2 * drawn.height]);
    assert.ok(drawn.colours > 30 && seen.colours > 30, `${drawn.colours}, ${seen.colours} colours`);
});

test("the soil is saved as PNG and SVG with its legend, and as a film that says when it is not at rest", async () => {
    const run = api.add_run({ ...study, name: "moving", title: "Still moving", transfer_times: [0.5] }, { began: Date.now() - 60000, flagged: { 0.5: [still_moving] } });
    await open_run(run.id);
    await until("the verdict", async () => /Not at rest at the end \(moving, 12 % in motion\)/.test(await text_of("#view-verdict")));
    const drawing = await downloaded("#view-svg");
    assert.equal(drawing.name, "moving_epsilon_q_12s.svg");
    for (const part of ["Still moving", "MPM from t_T = 0.5 s, t = 12.00 s", "deviatoric strain ε_q [–]", "Not at rest at the end", "Range fixed", run.id]) {
        assert.ok(drawing.bytes.toString().includes(part), `${part} is in it`);
    }
    const png = await looked_at("image/png", (await downloaded("#view-png")).bytes);
    assert.ok(png.colours > 100, `${png.colours} colours`);
    const film = await downloaded("#view-film");
    assert.match(film.name, /\.webm$/);
    const seen = await looked_at("video/webm", film.bytes);
    assert.ok(Math.abs(2 * seen.first.width - png.width) <= 4);
    assert.ok(seen.last.colours > 100 && seen.first.sum !== seen.last.sum, `it moves: ${JSON.stringify(seen)}`);
    assert.ok(seen.length > 2, `${seen.length} s`); // 25 pictures at most 12 per second, and the last one stays
    console.log(`a film of 25 pictures: ${film.bytes.length} bytes, ${seen.length} s, ${seen.first.width} x ${seen.first.height}`);
    assert.equal(await text_of("#view-film"), "Film (WebM)");
    await page.goto(`${url}/#/compare/run-1-task-3/${run.id}-task-3`);
    for (const [side, time] of [0.25, 0.5].entries()) await until("its picture", async () => (await text_of(`#compare-says-${side}`)).includes(`t_T = ${time} s;`));
    assert.ok((await canvas_facts(page, "compare-1")).share > 0.02);
    const both = (await downloaded("#compare-svg")).bytes.toString();
    assert.equal(both.match(/<image /g).length, 2);
    assert.match(both, /Right: Not at rest at the end/);
});

test("all of it fits at 1400, 1000 and 400 px", async () => {
    for (const width of [1000, 400, 1400]) {
        await page.setViewportSize({ width, height: 900 });
        await page.goto(`${url}/?${width}`); // without the pictures of the width before
        await open_mesh("r_u");
        await page.check("#view-vectors");
        for (const [id, value] of [["x1", 5], ["y1", 24], ["x2", 5], ["y2", 0]]) await page.fill(`#cut-${id}`, String(value));
        const overflow = () => page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
        assert.ok((await overflow()) <= 0, `run at ${width} px`);
        await screenshot(page, `views_mesh_${width}`);
        await page.click("#view-compare");
        await page.evaluate(() => { // a title as long as they may be
            for (const select of document.querySelectorAll("#compare select")) select.append(new Option("long ".repeat(40)));
        });
        await until("both", async () => (await canvas_facts(page, "compare-1")).share > 0.02);
        assert.ok((await overflow()) <= 0, `comparison at ${width} px`);
        await screenshot(page, `views_compare_${width}`);
    }
});

test("nothing failed inside the page", () => {
    assert.deepEqual(browser.complaints, []);
    assert.deepEqual(browser.foreign, []);
});
