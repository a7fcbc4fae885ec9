// Where a number comes from: the tasks behind one point of the sweep, from its runout back to its FEM, with settings, inputs, files,
// hashes, and the command to repeat them.
import * as api from "./api.js";
import { by_id, element, set_text } from "./dom.js";
import { flag_items } from "./flags.js";
import { bytes, clock, is_active, number, point_name, seconds, short_json, show_state, task_name, task_state } from "./format.js";
import { moments } from "./triggers.js";

const column_names = {
    runout: ["runout", "m"], runout_beyond_toe: ["runout of what passed the toe", "m"], runout_largest: ["farthest point", "m"],
    volume_ratio: ["volume ratio", "–"], numerical_share: ["numerical share of the released energy", "–"],
    overlap: ["overlap", "–"], factor_of_safety: ["factor of safety", ""],
    factor_of_safety_liquefied: ["factor of safety, liquefied", ""],
    factor_of_safety_post_seismic: ["factor of safety after shaking", ""], cpu_seconds: ["CPU time of the MPM run", "s"],
};
const result_paths = { numerical_share: "energy.numerical.share", factor_of_safety_liquefied: "stages[-1].factor_of_safety",
                       factor_of_safety_post_seismic: "after_shaking[].factor_of_safety" }; // other columns have the same name in result.json

export class Provenance {
    /// look_at(row): called to show this point's particles.
    constructor(look_at) {
        this.dialog = by_id("provenance");
        by_id("provenance-close").addEventListener("click", () => this.dialog.close());
        by_id("provenance-look").addEventListener("click", () => {
            this.dialog.close();
            look_at(this.row);
        });
    }

    async ask(run, row, column) {
        this.row = row;
        const [name, unit] = column_names[column] ?? [column, ""];
        set_text(by_id("provenance-title"), `${name}: ${number(row[column], 6)} ${unit}`);
        const value = Number.isFinite(row[column]) ? `Exactly ${row[column]}: ` : "";
        const stability = column.startsWith("factor_of_safety") ? stability_of(run, row, column) : null;
        set_text(by_id("provenance-where"), `${value}${point_name(row) || run.name}. “${result_paths[column] ?? column}” in result.json of ` +
                                            `task ${stability?.id ?? row.mpm_task}${row.reason ? `. ${row.state}: ${row.reason}` : ""}`);
        by_id("provenance-look").hidden = !Number.isFinite(row.runout);
        by_id("provenance-chain").replaceChildren(element("p", { class: "muted" }, "Reading…"));
        if (!this.dialog.open) this.dialog.showModal();
        try {
            const steps = await chain_of(run, row, stability);
            if (this.row !== row) return;
            by_id("provenance-chain").replaceChildren(asked_for(run, row, steps),
                                                     ...steps.map((step) => step_section(step, (run.study?.variants ?? []).length > 0)));
        } catch (fault) {
            set_text(by_id("provenance-chain"), `This could not be read: ${fault.message}`);
        }
    }
}

/// The stability analysis of a row's variant, or the shared one.
export const stability_of = (run, { variant }, column = "") => run.tasks.find((task) =>
    task.phase === (column.endsWith("post_seismic") ? "post_seismic" : "lem_tool") && [variant, ""].includes(task.variant));

let known = { run: null, count: 0, fems: new Map() }; // of the last run

/// Map of a run's transfer tasks to their FEM tasks; read again when the run has more transfers.
export async function fems_of(run) {
    const count = run.tasks.filter(({ phase }) => phase === "transfer_tool").length;
    if (known.run !== run.id || known.count !== count)
        known = { run: run.id, count, fems: count ? await api.fems_of_transfers(run.id) : new Map() };
    return known.fems;
}

/// The id of the FEM task behind a transfer. A FEM shared by several variants has the name of the first, so the name is used only if the
/// server does not report the FEM.
export function fem_of(run, transfer, fems, variant = transfer?.variant) {
    if (fems.has(transfer?.id)) return fems.get(transfer.id);
    const all = run.tasks.filter(({ phase }) => phase === "fem_solver");
    return (all.find((task) => task.variant === variant) ?? (all.length === 1 ? all[0] : null))?.id;
}

/// The tasks from the runout back to the FEM, or the analysis of a factor of safety, each as {task, provenance: from its result.json, or
/// from fault.json after a breakdown, or null}.
async function chain_of(run, row, stability) {
    const transfer = run.tasks.find((task) => task.id === row.transfer_task);
    const fem_id = stability ? null : fem_of(run, transfer, await fems_of(run), transfer?.variant || row.variant);
    const fem = run.tasks.find((task) => task.id === fem_id);
    const mpm = run.tasks.find((task) => task.id === row.mpm_task);
    return Promise.all((stability ? [stability] : [mpm, transfer, fem]).filter(Boolean).map(async (listed) => {
        const task = await api.read_task(listed.id);
        const file = task.artifacts.find(({ name }) => name === "result.json") ?? task.artifacts.find(({ name }) => name === "fault.json");
        const result = file ? await api.read_json_artifact(file.sha256).catch(() => null) : null;
        return { task, provenance: result?.provenance ?? null };
    }));
}

/// The reason of this transfer: a time in the study, or a trigger with its values.
function asked_for(run, row, steps) {
    const trigger = run.triggers.find(({ name }) => name && name === row.trigger);
    const firing = trigger?.firings.find((each) => Math.abs(each.transfer_time - row.transfer_time) < 1e-6);
    const variant = run.study?.variants?.find(({ name }) => name === row.variant);
    const transferred = Boolean(row.transfer_task);
    const lines = !transferred ? [] : [["transfer asked for by", firing ? `trigger ${trigger.name} (${trigger.kind})` : "a time of the study"]];
    if (firing) {
        const [moment] = moments([{ ...trigger, firings: [firing] }]);
        if (moment) lines.push(["fired", moment.label]);
        if (firing.crossed) lines.push(["what it saw", short_json(firing.crossed)]);
        lines.push(["snapshot", `${firing.snapshot}, SHA-256 ${firing.sha256}`]);
    }
    if (variant) lines.push(["variant sets", (variant.overrides ?? []).join(", ") || "nothing"]);
    const cost = steps.reduce((sum, { provenance }) => sum + (provenance?.cpu_seconds ?? 0), 0);
    lines.push(["CPU time", seconds(cost) + (transferred ? " of the chain when it was computed (the FEM and the transfer serve other points too)" : "")]);
    return facts(lines);
}

function step_section({ task, provenance }, has_variants) {
    const state = element("span");
    show_state(state, task_state(task));
    return element("section", { class: "step" },
        element("div", { class: "row" }, element("h3", {}, task_name(task)), state),
        facts(facts_of(task, provenance)),
        task.flags?.length ? element("ul", { class: "flags" }, ...flag_items(task.flags)) : null,
        settings(task, provenance, has_variants && task.variant === "" ? " (given by one variant for all that share this task)" : ""),
        files(task),
        again(task, provenance));
}

function facts_of(task, provenance) {
    const last = task.attempts.at(-1);
    const why = task.why ? [task.why.reason, ...(task.why.differs ?? [])].join(", ") : "";
    const lines = [["task", task.id]];
    if (provenance) lines.push(["version", provenance.version], ["threads", String(provenance.threads)]);
    if (last) {
        lines.push(["finished", clock(last.finished)], ["CPU", seconds(last.cpu_seconds)], ["wall", seconds(last.wall_seconds)],
                   ["attempts", String(task.attempts.length)]);
    }
    if (task.same_as) lines.push(["taken from", task.same_as], ["CPU then", seconds(provenance?.cpu_seconds)]);
    if (why) lines.push(["why it ran", why]);
    return lines;
}

const facts = (lines) => element("dl", { class: "facts" }, ...lines.map(([name, text]) =>
    element("div", {}, element("dt", {}, name), element("dd", {}, text))));

const hash_link = (sha256, name) => element("a", { href: api.artifact_path(sha256), download: name }, element("code", {}, sha256));
const file_name = (path) => path.split("/").at(-1);

/// Why a task has no result, and what is unknown therefore.
function no_result(task) {
    if (is_active(task.state)) return "No result.json yet.";
    if (task.not_reached) return `Not reached: ${task.fault?.summary ?? ""}.`;
    const code = Number.isFinite(task.fault?.exit_code) ? ` with exit code ${task.fault.exit_code}` : "";
    const fault = task.fault ? `${code}: ${task.fault.summary}` : "";
    return `It left no result.json: it ended as “${task.state}”${fault}. Which version and settings it had is not known from here; ` +
           "scene.completed.json and the log say what it was given.";
}

function settings(task, provenance, shared) {
    if (!provenance) return element("p", { class: "muted" }, no_result(task));
    const overrides = provenance.overrides ?? [];
    const inputs = provenance.inputs ?? [];
    return element("div", {},
        element("h4", {}, `Settings over the scene${overrides.length ? shared : ""}`),
        overrides.length ? element("ul", {}, ...overrides.map((each) => element("li", {}, element("code", {}, each)))) : element("p", {}, "none"),
        element("h4", {}, "Inputs"),
        inputs.length ? element("ul", {}, ...inputs.map(({ path, sha256 }) =>
            element("li", {}, `${file_name(path)} `, hash_link(sha256, file_name(path))))) : element("p", {}, "the scene alone"));
}

const first_names = ["result.json", "scene.completed.json", "telemetry.jsonl", "history.h5"];

function files(task) {
    const rank = ({ name }) => (first_names.indexOf(name) + 1 || 99);
    const sorted = [...task.artifacts].sort((a, b) => rank(a) - rank(b));
    if (sorted.length === 0) return element("p", { class: "muted" }, "No files of its own.");
    return element("details", {}, element("summary", {}, `${sorted.length} files with their hashes`),
        element("div", { class: "scroll tall", tabindex: 0, role: "region", "aria-label": `files of ${task_name(task)}` },
            element("table", {}, element("tbody", {}, ...sorted.map((file) => element("tr", {},
                element("th", { scope: "row" }, file.name), element("td", { class: "number" }, bytes(file.bytes)),
                element("td", {}, hash_link(file.sha256, file.name))))))));
}

/// The completed scene includes the overrides.
function again(task, provenance) {
    if (!provenance) return null;
    const inputs = (provenance.inputs ?? []).map(({ path }) => ` --input ${file_name(path)}`).join("");
    return element("div", {}, element("h4", {}, "The same again by hand, with the files above"),
        element("pre", {}, `${task.phase} scene.completed.json${inputs} --threads ${provenance.threads} --output again`));
}
