// The list of runs at the side, and the head of the run that is open.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { clock, elapsed, is_active, percent, show_state } from "./format.js";

export const run_address = (id) => `#/runs/${encodeURIComponent(id)}`;

export function draw_list(runs, open_id) {
    by_id("no-runs").hidden = runs.length > 0;
    mirror(by_id("run-list"), runs, (run) => run.id, new_item, (item, run) => fill_item(item, run, open_id));
}

function new_item(run) {
    return element("li", {}, element("a", { href: run_address(run.id) },
        element("span", { class: "run-name" }), element("span"), element("progress", { max: 1 }),
        element("span", { class: "run-time" })));
}

function fill_item(item, run, open_id) {
    const link = item.firstElementChild;
    const [name, state, progress, time] = link.children;
    set_text(name, run.name);
    show_state(state, run.state);
    progress.value = run.progress ?? 0;
    progress.hidden = !is_active(run.state);
    progress.setAttribute("aria-label", `progress of ${run.name}`);
    set_text(time, `${clock(run.created)} · ${is_active(run.state) ? percent(run.progress) + " · " : ""}` +
                   `${run.tasks_done} of ${run.tasks_total} tasks`);
    link.title = run.title || run.name;
    if (run.id === open_id) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
}

export class RunHead {
    /// changed(): the run was told to stop.
    constructor(changed) {
        this.changed = changed;
        by_id("cancel").addEventListener("click", () => by_id("cancel-dialog").showModal());
        by_id("cancel-dialog").addEventListener("close", () => this.answer(by_id("cancel-dialog").returnValue));
    }

    show(run) {
        this.run = run;
        set_text(by_id("run-title"), run.title || run.name);
        document.title = `${percent(run.progress)} ${run.name} – Breachline`;
        show_state(by_id("run-state"), run.state);
        by_id("run-progress").value = run.progress ?? 0;
        set_text(by_id("run-summary"), summary(run));
        set_text(by_id("run-message"), run.message ?? "");
        set_text(by_id("run-id"), run.id);
        by_id("cancel").hidden = !is_active(run.state);
        set_text(by_id("cancel-what"), run.title || run.name);
    }

    async answer(choice) {
        by_id("cancel-dialog").returnValue = "";
        if (choice !== "cancel-run") return;
        try {
            await api.cancel_run(this.run.id);
            this.changed();
        } catch (fault) {
            set_text(by_id("run-message"), `Cancelling failed: ${fault.message}`);
        }
    }
}

function summary(run) {
    const parts = [`${run.tasks_done} of ${run.tasks_total} tasks done`];
    if (run.tasks_failed > 0) parts.push(`${run.tasks_failed} failed`);
    parts.push(`created ${clock(run.created)}`);
    if (run.started) parts.push(`${is_active(run.state) ? "running for" : "took"} ${elapsed(run.started, run.finished)}`);
    return parts.join(" · ");
}
