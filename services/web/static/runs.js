// The list of runs, and the head of the open run.
import * as api from "./api.js";
import { differences_address } from "./differences.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { verdict_look, verdict_sign } from "./flags.js";
import { bytes, clock, is_active, percent, show_state, span, task_state } from "./format.js";
import { RenameDialog } from "./rename.js";
import { has_verdict, shown_state } from "./run_picker.js";

export const run_address = (id) => `#/runs/${encodeURIComponent(id)}`;

function show_badge(badge, run) {
    if (!has_verdict(run)) return show_state(badge, shown_state(run));
    const { verdict } = run;
    const look = verdict_look(verdict.usable);
    badge.className = `state ${look}`;
    set_text(badge, `${verdict_sign(verdict.usable)} ${verdict.words}`);
}

/// The search text; "": none.
export const searched = () => by_id("run-search").value.trim();

/// {runs, next}: from api.find_runs.
export function draw_list({ runs, next }, open_id) {
    by_id("no-runs").hidden = runs.length > 0;
    set_text(by_id("no-runs"), searched() ? "None has this in its name, title or id." : "None yet.");
    by_id("more-runs").hidden = !next;
    set_text(by_id("more-runs"), `The newest ${runs.length}; ${searched() ? "there are more" : "search finds older ones"}.`);
    mirror(by_id("run-list"), runs, (run) => run.id, new_item, (item, run) => fill_item(item, run, open_id));
}

function new_item(run) {
    return element("li", {}, element("a", { href: run_address(run.id) },
        element("span", { class: "run-name" }), element("span"), element("span", { class: "run-called" }), element("span", { class: "run-answer" }),
        element("progress", { max: 1 }), element("span", { class: "run-time" }), element("span", { class: "run-why" })));
}

function fill_item(item, run, open_id) {
    const link = item.firstElementChild;
    const [name, state, called, answer, progress, time, why] = link.children;
    set_text(name, run.name);
    set_text(called, run.title);
    called.hidden = !run.title;
    set_text(answer, run.headline.text);
    answer.hidden = answer.textContent === "";
    show_badge(state, run);
    progress.value = run.progress ?? 0;
    progress.hidden = !is_active(run.state);
    progress.setAttribute("aria-label", `progress of ${run.name}`);
    set_text(time, `${clock(run.created)} · ${is_active(run.state) ? percent(run.progress) + " · " : ""}` +
                   `${run.tasks_done} of ${run.tasks_total} tasks`);
    const reason = doubt_of(run);
    set_text(why, reason);
    why.classList.toggle("unusable", run.verdict.usable === "no");
    why.hidden = why.textContent === "";
    link.title = [run.title || run.name, run.message].filter(Boolean).join("\n");
    if (run.id === open_id) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
}

/// The worst reason if the results are questionable or unusable; else "".
const doubt_of = ({ verdict: { usable, reasons } }) => (["questionable", "no"].includes(usable) ? reasons[0]?.brief ?? "" : "");

/// The parts of the run's message that are not reasons of its verdict.
function beside_the_verdict({ verdict, message }) {
    const told = new Set(verdict.reasons.flatMap(({ brief }) => brief.split("; ")));
    return (message ?? "").split("; ").filter((part) => !told.has(part)).join("; ");
}

export class RunHead {
    /// changed(): called after an order to the run. edit(study): called to run it again with changes.
    constructor(changed, edit) {
        this.changed = changed;
        by_id("again").addEventListener("click", () => edit(this.run.study));
        by_id("cancel").addEventListener("click", () => by_id("cancel-dialog").showModal());
        by_id("cancel-dialog").addEventListener("close", () => this.answer(by_id("cancel-dialog").returnValue));
        by_id("remove").addEventListener("click", () => this.ask_removal());
        this.rename = new RenameDialog(changed);
        by_id("rename").addEventListener("click", () => this.rename.open(this.run));
        by_id("remove-dialog").addEventListener("close", () => this.answer_removal(by_id("remove-dialog").returnValue));
        for (const order of ["pause", "resume", "retry"]) by_id(order).addEventListener("click", () => this.command(order));
    }

    /// Shows what the list knows of a run before the rest arrives.
    begin(run) {
        set_text(by_id("run-title"), run.title || run.name);
        document.title = `${percent(run.progress)} ${run.name} – Breachline`;
        show_badge(by_id("run-state"), run);
        by_id("run-progress").value = run.progress ?? 0;
        by_id("run-progress").hidden = !is_active(run.state);
        set_text(by_id("run-message"), beside_the_verdict(run));
    }

    show(run) {
        this.run = run;
        this.begin(run);
        const active = is_active(run.state);
        set_text(by_id("run-summary"), summary(run));
        set_text(by_id("run-id"), run.id);
        by_id("differences-with").href = differences_address(run.id);
        by_id("report").href = api.report_of(run.id);
        by_id("report").hidden = run.tasks_done === 0;
        by_id("cancel").hidden = !active;
        by_id("pause").hidden = !active || run.paused;
        by_id("resume").hidden = !active || !run.paused;
        by_id("retry").hidden = active || !run.tasks.some((task) => ["failed", "cancelled", "skipped"].includes(task_state(task)));
        by_id("remove").hidden = active;
        set_text(by_id("cancel-what"), run.title || run.name);
        set_text(by_id("remove-what"), run.title || run.name);
    }

    async answer(choice) {
        by_id("cancel-dialog").returnValue = "";
        if (choice === "cancel-run") await this.command("cancel");
    }

    /// Shows the disk space that the removal frees; the server may need a moment.
    async ask_removal() {
        const { id } = this.run;
        const say = (text) => set_text(by_id("remove-frees"), text);
        say("Reading the disk space that this frees…");
        by_id("remove-dialog").showModal();
        try {
            const use = (await api.read_storage()).runs.find((run) => run.id === id);
            if (this.run.id !== id) return;
            say(!use ? "" : `This frees ${bytes(use.freed_bytes)} of disk` +
                (use.shared_bytes > 0 ? `; ${bytes(use.shared_bytes)} more are shared with other runs and stay.` : "."));
        } catch (fault) {
            say(`How much disk that gives back is not known: ${fault.message}`);
        }
    }

    async answer_removal(choice) {
        by_id("remove-dialog").returnValue = "";
        if (choice !== "remove-run") return;
        try {
            await api.remove_run(this.run.id);
            location.hash = "#/";
            this.changed();
        } catch (fault) {
            set_text(by_id("run-message"), `The server refused to remove this run: ${fault.message}`);
        }
    }

    async command(order) {
        try {
            await api.command_run(this.run.id, order);
            this.changed();
        } catch (fault) {
            set_text(by_id("run-message"), `The server refused to ${order} this run: ${fault.message}`);
        }
    }
}

function times_of({ finished, computing_seconds: computing, idle_seconds: idle }) {
    if (computing > 0) return `computing ${span(computing)}, idle ${span(idle)}`;
    return finished ? "nothing computed: all taken from earlier runs" : "nothing computed yet";
}

function summary(run) {
    const parts = [`${run.tasks_done} of ${run.tasks_total} tasks done`];
    if (run.tasks_failed > 0) parts.push(`${run.tasks_failed} failed`);
    if (run.questionable > 0) parts.push(`${run.questionable} questionable`);
    parts.push(`created ${clock(run.created)}${run.submitted_by ? ` by ${run.submitted_by}` : ""}`);
    parts.push(times_of(run));
    if (run.paused && is_active(run.state)) parts.push("paused: nothing new is started");
    if (Number.isFinite(run.seconds_left)) parts.push(`about ${span(run.seconds_left)} left`);
    return parts.join(" · ");
}
