// Puts the page together: which run is open, when to look again, what to say when the server is gone.
import * as api from "./api.js";
import { by_id, set_text } from "./dom.js";
import { is_active } from "./format.js";
import { Particles } from "./particles.js";
import { Results } from "./results.js";
import { draw_list, run_address, RunHead } from "./runs.js";
import { SubmitDialog } from "./submit.js";
import { Tasks } from "./tasks.js";
import { Telemetry } from "./telemetry.js";

const settle = 250;        // [ms] events that arrive together cause one look
const look_again = 1500;   // [ms] between looks while something runs: progress is no event

const particles = new Particles();
const results = new Results((transfer_time) => {
    particles.show_transfer_time(transfer_time);
    by_id("particles").scrollIntoView({ block: "nearest" });
});
const telemetry = new Telemetry();
const tasks = new Tasks();
const head = new RunHead(() => look_soon());
new SubmitDialog((run) => {
    location.hash = run_address(run.id);
    look_soon();
});

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

// ---- looking

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
    try {
        const runs = await api.list_runs();
        draw_list(runs, open_id());
        busy = runs.some((run) => is_active(run.state));
        await show_open_run();
        by_id("page-fault").hidden = true;
    } catch (fault) {
        busy = true; // look again
        if (!(fault instanceof api.Unreachable)) {
            console.error(fault);
            set_text(by_id("page-fault"), fault.message);
            by_id("page-fault").hidden = false;
        }
    } finally {
        looking = false;
        if (again) look_soon();
        else if (busy) look_soon(look_again);
    }
}

async function show_open_run() {
    const id = open_id();
    by_id("welcome").hidden = id !== "";
    by_id("missing").hidden = true;
    if (id === "") {
        by_id("run").hidden = true;
        document.title = "Breachline";
        return;
    }
    let run;
    try {
        run = await api.read_run(id);
    } catch (fault) {
        if (!(fault instanceof api.Problem) || fault.status !== 404) throw fault;
        by_id("run").hidden = true;
        by_id("missing").hidden = false;
        return;
    }
    if (id !== open_id()) return;
    by_id("run").hidden = false;
    head.show(run);
    await tasks.show(run);
    // One part that fails must not hide the others.
    const parts = await Promise.allSettled([results.show(run), telemetry.show(run), particles.show(run)]);
    const broken = parts.find((part) => part.status === "rejected");
    if (broken) throw broken.reason;
}

// ---- light and dark

const themes = ["auto", "light", "dark"];
const signs = { auto: "◐ Auto", light: "☀ Light", dark: "☾ Dark" };

function set_theme(theme) {
    document.documentElement.dataset.theme = theme;
    set_text(by_id("theme"), signs[theme]);
    by_id("theme").setAttribute("aria-label", `Colours: ${theme}. Press to change.`);
    localStorage.setItem("theme", theme);
    particles.view.redraw();
}
by_id("theme").addEventListener("click", () => {
    set_theme(themes[(themes.indexOf(document.documentElement.dataset.theme) + 1) % themes.length]);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => particles.view.redraw());
const stored = localStorage.getItem("theme");
set_theme(themes.includes(stored) ? stored : "auto");

// ---- begin

window.addEventListener("hashchange", () => {
    look_soon(0);
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
