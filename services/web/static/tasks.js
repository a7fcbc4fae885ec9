// The tasks of a run: a picture of the workflow, a table, and one task in detail.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { by_point, bytes, clock, elapsed, is_active, number, percent, seconds, show_state, state_look, task_name, task_state, variants_of } from "./format.js";
import { flag_codes, flag_items, flag_note } from "./flags.js";
import { LogView } from "./log.js";

const most_in_flow = 40; // variants; more would be too many rows

const order = ["lem_tool", "fem_solver", "post_seismic", "transfer_tool", "mpm_solver"];

function in_order(tasks, variants) {
    const points = by_point(variants);
    return [...tasks].sort((a, b) => points(a, b) || order.indexOf(a.phase) - order.indexOf(b.phase));
}

export class Tasks {
    constructor() {
        this.log = new LogView();
        this.chosen = null;
        by_id("task-close").addEventListener("click", () => this.close());
    }

    async show(run) {
        if (this.run?.id !== run.id) this.close();
        this.run = run;
        const variants = variants_of(run);
        const tasks = in_order(run.tasks, variants);
        by_id("tasks").classList.toggle("one-variant", variants.length === 1);
        this.draw_flow(tasks);
        mirror(by_id("task-rows"), tasks, (task) => task.id, (task) => this.new_row(task), fill_row);
        const chosen = tasks.find((task) => task.id === this.chosen);
        if (chosen) await this.detail(chosen);
    }

    /// LEM and FEM, then one column per transfer time: transfers above runouts, one row per variant.
    draw_flow(tasks) {
        by_id("flow").hidden = variants_of(this.run).length > most_in_flow;
        if (by_id("flow").hidden) return;
        const single = tasks.filter((task) => !Number.isFinite(task.transfer_time));
        const rows = rows_of(tasks);
        const times = [...new Set(tasks.map((task) => task.transfer_time).filter(Number.isFinite))];
        mirror(by_id("flow-single"), single, (task) => task.id, (task) => this.new_chip(task), fill_named_chip);
        mirror(by_id("flow-head"), times.length ? [{ name: "t_T [s]" }, ...rows] : [], ({ name }) => name,
               () => element("span"), (label, { name }) => set_text(label, name));
        mirror(by_id("flow-times"), times, (time) => time, () => element("div", { class: "flow-column" },
               element("span", { class: "flow-time" }), element("div", { class: "flow-stack" })),
               (column, time) => {
                   set_text(column.firstElementChild, number(time));
                   mirror(column.lastElementChild, rows, ({ name }) => name, () => element("div"), (place, row) =>
                       mirror(place, tasks.filter((task) => task.transfer_time === time && row.holds(task)),
                              (task) => task.id, (task) => this.new_chip(task), fill_chip));
               });
    }

    new_chip(task) {
        return element("button", { type: "button", onclick: () => this.open(task.id) });
    }

    new_row(task) {
        const open = element("button", { type: "button", class: "link", onclick: () => this.open(task.id) });
        return element("tr", {}, element("th", { scope: "row" }, open), element("td", { class: "variant" }),
                       element("td", { class: "number" }), element("td", {}, element("span")),
                       element("td", { class: "share" }, element("progress", { max: 1 }), " ", element("span", { class: "number" })),
                       element("td", { class: "number" }), element("td", { class: "number" }),
                       element("td", { class: "message" }));
    }

    async open(id) {
        this.chosen = id;
        const task = this.run.tasks.find((candidate) => candidate.id === id);
        if (!task) return;
        by_id("task").hidden = false;
        await this.detail(task);
        by_id("task-title").focus({ preventScroll: true });
        by_id("task").scrollIntoView({ block: "nearest" });
    }

    close() {
        this.chosen = null;
        by_id("task").hidden = true;
        this.log.close();
    }

    async detail(task) {
        set_text(by_id("task-title"), task_name(task));
        show_state(by_id("task-state"), task_state(task));
        draw_flags(task);
        const fault = task.fault ? `Exit code ${task.fault.exit_code}: ${task.fault.summary}` : "";
        by_id("task-fault").hidden = !fault;
        set_text(by_id("task-fault"), fault);
        mirror(by_id("task-attempts"), task.attempts, (attempt) => attempt.number, new_attempt, fill_attempt);
        mirror(by_id("task-artifacts"), task.artifacts, (file) => file.name + file.sha256, new_artifact, () => {});
        by_id("task-no-artifacts").hidden = task.artifacts.length > 0;
        draw_facts(task.result);
        await this.log.show(task);
    }
}

/// Rows of the picture: one per phase of a transfer and variant.
function rows_of(tasks) {
    const phases = [["transfer_tool", "transfer"], ["mpm_solver", "MPM"]];
    return phases.flatMap(([phase, name]) => {
        const variants = [...new Set(tasks.filter((task) => task.phase === phase).map((task) => task.variant))];
        return variants.map((variant) => ({ name: variant ? `${name}, ${variant}` : name,
                                            holds: (task) => task.phase === phase && task.variant === variant }));
    });
}

function fill_named_chip(chip, task) {
    fill_chip(chip, task);
    set_text(chip, `${state_look(task_state(task)).sign} ${task.phase}${task.variant && ` ${task.variant}`}`);
    chip.classList.add("named");
}

function fill_chip(chip, task) {
    const { family, sign } = state_look(task_state(task));
    chip.className = `flow-chip ${family}`;
    chip.style.setProperty("--progress", percent(task.progress).replace(" ", ""));
    set_text(chip, sign);
    const text = `${task_name(task)}: ${task_state(task).replace("_", " ")}, ${percent(task.progress)}`;
    chip.title = task.flags?.length ? `${text}\n${flag_note(task)}` : text;
    chip.setAttribute("aria-label", text);
}

function fill_row(row, task) {
    const [name, variant, time, state, progress, attempts, took, message] = row.children;
    set_text(name.firstElementChild, task.phase);
    set_text(variant, task.variant);
    set_text(time, Number.isFinite(task.transfer_time) ? number(task.transfer_time) : "");
    show_state(state.firstElementChild, task_state(task));
    state.title = task.flags?.length ? flag_note(task) : "";
    const never_ran = task.attempts.length === 0 && !is_active(task.state);
    progress.firstElementChild.hidden = never_ran;
    progress.firstElementChild.value = task.progress ?? 0;
    progress.firstElementChild.setAttribute("aria-label", `progress of ${task_name(task)}`);
    set_text(progress.lastElementChild, never_ran ? "–" : percent(task.progress));
    set_text(attempts, String(task.attempts.length));
    const last = task.attempts.at(-1);
    set_text(took, last ? (Number.isFinite(last.wall_seconds) ? seconds(Number(last.wall_seconds.toPrecision(3)))
                                                              : elapsed(last.started, last.finished)) : "");
    const flagged = task.flags?.length ? flag_codes(task.flags) : "";
    set_text(message, task.fault?.summary || flagged || (task.message ?? ""));
}

/// For a successful task: its flags, or that they are unknown.
function draw_flags(task) {
    const went_well = ["succeeded", "cached"].includes(task.state);
    by_id("task-flags").hidden = !went_well || task.flags?.length === 0;
    by_id("task-flags").replaceChildren(...(task.flags ? flag_items(task.flags) : [element("li", {}, flag_note(task))]));
}

function new_attempt() {
    return element("tr", {}, element("th", { scope: "row" }), element("td", {}, element("span")),
                   ...Array.from({ length: 4 }, () => element("td", { class: "number" })));
}

function fill_attempt(row, attempt) {
    const [count, state, started, exit_code, wall, cpu] = row.children;
    set_text(count, String(attempt.number));
    show_state(state.firstElementChild, attempt.state);
    set_text(started, clock(attempt.started));
    set_text(exit_code, attempt.exit_code === null || attempt.exit_code === undefined ? "–" : String(attempt.exit_code));
    set_text(wall, seconds(attempt.wall_seconds));
    set_text(cpu, seconds(attempt.cpu_seconds));
}

function new_artifact(file) {
    return element("tr", {}, element("th", { scope: "row" },
                       element("a", { href: api.artifact_path(file.sha256), download: file.name }, file.name)),
                   element("td", { class: "number" }, bytes(file.bytes)),
                   element("td", {}, element("code", { title: file.sha256 }, file.sha256)));
}

/// The top-level values of result.json; the whole file is among the artifacts.
function draw_facts(result) {
    const facts = Object.entries(result ?? {}).filter(([, value]) => ["number", "string", "boolean"].includes(typeof value));
    by_id("task-facts").hidden = facts.length === 0;
    mirror(by_id("task-facts-list"), facts, ([name]) => name,
           () => element("div", {}, element("dt"), element("dd")),
           (entry, [name, value]) => {
               set_text(entry.firstElementChild, name.replaceAll("_", " "));
               set_text(entry.lastElementChild, typeof value === "number" ? number(value, 6) : String(value));
           });
}
