// Assembles the page: the open run, when to refresh, and the message when the server does not answer.
import { Answer, governing_of } from "./answer.js";
import * as api from "./api.js";
import { Compare } from "./compare.js";
import { Cost } from "./cost.js";
import { Database } from "./database.js";
import { Differences } from "./differences.js";
import { by_id, set_text } from "./dom.js";
import { is_active, variants_of } from "./format.js";
import { show_glossary } from "./glossary.js";
import { Motions } from "./motions.js";
import { Particles } from "./particles.js";
import { Plot } from "./plot.js";
import { Provenance } from "./provenance.js";
import { Results } from "./results.js";
import { draw_list, run_address, RunHead, searched } from "./runs.js";
import { SubmitDialog } from "./submit.js";
import { Tasks } from "./tasks.js";
import { Telemetry } from "./telemetry.js";
import { TokenDialog } from "./token.js";
import { Uncertainty } from "./uncertainty.js";

const settle = 250;        // [ms] collects events for one refresh
const look_again = 1500;   // [ms] between refreshes while something runs, because progress is no event
const most_share = 0.5;    // of the time for refreshing: large sweeps refresh less often

new TokenDialog();
Plot.of = () => (by_id("run").hidden ? "" : by_id("run-title").textContent);
const particles = new Particles((task) => results.rows.find((row) => row.mpm_task === task));
function look_at(row) {
    particles.show_point(row);
    by_id("particles").scrollIntoView({ block: "nearest" });
    by_id("view").focus({ preventScroll: true });
}

const provenance = new Provenance(look_at);
const ask = (row, column) => provenance.ask(results.run, row, column);
const results = new Results({ look_at, ask });
const cost = new Cost((key, column) => ask(results.row(key), column));
const database = new Database();
const compare = new Compare();
const telemetry = new Telemetry();
const tasks = new Tasks();
const motions = new Motions();
const uncertainty = new Uncertainty({ open_task: (id) => tasks.open(id), ask: (sample) => ask(results.rows.find((row) => row.variant === sample), "runout") });
const answer = new Answer(look_at);
const differences = new Differences();
const submission = new SubmitDialog((run) => {
    location.hash = run_address(run.id);
    look_soon();
});
const head = new RunHead(() => look_soon(), (study) => submission.edit(study));

by_id("run-search").addEventListener("input", () => look_soon());

const open_table = () => location.hash.match(/^#\/database(?:\/([^/]+))?(?:\/([^/]+))?$/);
const open_word = () => location.hash.match(/^#\/glossary(?:\/([a-z0-9_-]+))?$/);
const pair_in = (view) => location.hash.match(new RegExp(`^#/${view}/([^/]+)(?:/([^/]+))?$`))?.slice(1).filter(Boolean).map(decodeURIComponent);
const open_id = () => decodeURIComponent(location.hash.match(/^#\/runs\/(.+)$/)?.[1] ?? "");

// ---- connection

function say_lost(retry_in) {
    by_id("connection").className = "lost";
    set_text(by_id("connection"), `Connection lost, retrying in ${retry_in} s. What you see may be old.`);
}

function say_found() {
    const was_lost = by_id("connection").className === "lost";
    by_id("connection").className = "live";
    set_text(by_id("connection"), "Live");
    return was_lost;
}

// ---- refreshing

let looking = false;
let again = false;
let timer = 0;

function look_soon(delay = settle) {
    if (looking) {
        again = true;
        return;
    }
    clearTimeout(timer);
    timer = setTimeout(look, delay);
}

async function look() {
    looking = true;
    again = false;
    let busy = false;
    const began = performance.now();
    try {
        const search = searched();
        const found = await api.find_runs(search);
        if (search === searched()) draw_list(found, open_id());
        busy = found.runs.some((run) => is_active(run.state));
        await show_open_run(found.runs);
        by_id("page-fault").hidden = true;
    } catch (fault) {
        busy = true; // refresh again
        if (!(fault instanceof api.Unreachable)) {
            console.error(fault);
            set_text(by_id("page-fault"), fault.message);
            by_id("page-fault").hidden = false;
        }
    } finally {
        looking = false;
        by_id("loading").hidden = !again;
        if (again) look_soon();
        else if (busy) look_soon(Math.max(look_again, (performance.now() - began) / most_share));
    }
}

// ---- the open run: never shows numbers of the previous run; each part appears when its data arrive

const parts_of_a_run = ["run-orders", "run-summary", "answer", "uncertainty", "motions", "runouts", "particles", "telemetry", "cost", "tasks"];
let expected = "";

function expect_parts_of(id) {
    if (id === expected) return;
    expected = id;
    for (const part of parts_of_a_run) by_id(part).classList.add("coming");
}

async function arrives(shown, ...parts) {
    await shown;
    for (const part of parts) by_id(part).classList.remove("coming");
}

/// listed: runs in the list, enough for a first display.
async function show_open_run(listed) {
    const id = open_id();
    const tables = open_table() !== null;
    const word = open_word();
    const [pictures, numbers] = ["compare", "differences"].map(pair_in);
    const pair = pictures ?? numbers;
    by_id("welcome").hidden = tables || Boolean(pair ?? word) || id !== "";
    by_id("glossary").hidden = !word;
    by_id("compare").hidden = !pictures;
    by_id("differences").hidden = !numbers;
    by_id("database").hidden = !tables;
    by_id("missing").hidden = true;
    if (tables) {
        document.title = "Run database – Breachline";
        await database.look_at_workers();
    }
    if (pair) document.title = "Comparison – Breachline";
    if (tables || id === "") {
        by_id("run").hidden = true;
        if (pair) await show_pair(pair, pictures ? [compare, "compare"] : [differences, "differences"]);
        else if (word) document.title = "Glossary – Breachline";
        else if (!tables) {
            document.title = "Breachline";
            await submission.offer_starts();
        }
        return;
    }
    const known = listed.find((each) => each.id === id);
    if (known && expected !== id) {
        expect_parts_of(id);
        head.begin(known);
        answer.begin(known);
        by_id("run").hidden = false;
        by_id("answer").classList.remove("coming");
        by_id("loading").hidden = true;
    }
    let run, read;
    try {
        [run, read] = await Promise.all([api.read_run(id), api.read_results(id)]);
        run.triggers = run.tasks.some(({ phase }) => phase === "fem_solver") ? await api.read_triggers(id) : [];
    } catch (fault) {
        if (!(fault instanceof api.Problem) || fault.status !== 404) throw fault;
        by_id("run").hidden = true;
        by_id("missing").hidden = false;
        return;
    }
    if (id !== open_id()) return;
    by_id("run").hidden = false;
    expect_parts_of(id);
    head.show(run);
    arrives(null, "run-orders", "run-summary");
    const governing = governing_of(run, read.rows, read.means);
    const show_answer = () => answer.show(run, read.rows, governing, uncertainty.quantiles_of_runout(id));
    const top = arrives(show_answer(), "answer");
    await next_picture();
    const rows = results.show(run, read);
    cost.show(run, rows, variants_of(run));
    // One part that fails must not hide the others.
    const parts = await Promise.allSettled([
        top, arrives(motions.show(run), "motions"), arrives(tasks.show(run), "tasks", "runouts", "cost"), arrives(uncertainty.show(run, rows).then(show_answer), "uncertainty"),
        arrives(telemetry.show(run, governing.row), "telemetry"), arrives(particles.show(run, governing.row?.mpm_task), "particles"),
    ]);
    const broken = parts.find((part) => part.status === "rejected");
    if (broken) throw broken.reason;
}

/// Draws the head before the tables of a large run.
const next_picture = () => new Promise((seen) => {
    if (document.hidden) seen();
    else requestAnimationFrame(() => setTimeout(seen));
});

async function show_pair(pair, [view, part]) {
    try {
        await view.show(pair);
    } catch (fault) {
        if (!(fault instanceof api.Problem) || fault.status !== 404) throw fault;
        by_id(part).hidden = true;
        by_id("missing").hidden = false;
    }
}

// ---- light and dark

const themes = ["auto", "light", "dark"];
const signs = { auto: "◐ Auto", light: "☀ Light", dark: "☾ Dark" };

function redraw_soil() {
    for (const view of [particles.view, ...compare.sides.map((side) => side.view)]) view.redraw();
}

function set_theme(theme) {
    document.documentElement.dataset.theme = theme;
    set_text(by_id("theme"), signs[theme]);
    by_id("theme").setAttribute("aria-label", `Colours: ${theme}. Press to change.`);
    localStorage.setItem("theme", theme);
    redraw_soil();
}
by_id("theme").addEventListener("click", () => {
    set_theme(themes[(themes.indexOf(document.documentElement.dataset.theme) + 1) % themes.length]);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw_soil);
const stored = localStorage.getItem("theme");
set_theme(themes.includes(stored) ? stored : "auto");

// ---- begin

function open_words() {
    const word = open_word();
    by_id("glossary").hidden = !word;
    if (!word) return;
    by_id("run").hidden = true;
    show_glossary(word[1]);
}

function open_database() {
    const table = open_table();
    if (table) database.show(table[1] ?? "runs", decodeURIComponent(table[2] ?? ""));
}

window.addEventListener("hashchange", () => {
    by_id("loading").hidden = false;
    look_soon(0);
    open_database();
    open_words();
    by_id("main").focus({ preventScroll: true });
});
api.follow_events({
    events: () => look_soon(),
    lost: say_lost,
    found: () => {
        if (say_found()) look_soon(0);
    },
});
look_soon(0);
open_database();
open_words();
