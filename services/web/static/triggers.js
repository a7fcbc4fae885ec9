// Thresholds in the conditions of a run's triggers, the times at which they fired, and the window and plateau that they found. No DOM,
// except for the table at the end.
import { by_id, element, mirror, set_text } from "./dom.js";
import { number, show_state } from "./format.js";
import { term } from "./glossary.js";

const value = "([+-]?(?:\\d+\\.?\\d*|\\.\\d+)(?:e[+-]?\\d+)?)";
const field = "([a-z_]\\w*)";
const begins = "(?<![*/+-]\\s*)(?<![\\w.])"; // not inside a formula or a word
const ends = "(?!\\s*[(*/+-]|[\\w.])";
const forwards = new RegExp(`${begins}${field}\\s*[<>]=?\\s*${value}${ends}`, "gi");
const backwards = new RegExp(`${begins}${value}\\s*[<>]=?\\s*${field}${ends}`, "gi");

/// Comparisons of one field with one number in a condition: [{field, y}]. Formulas have no line.
export function thresholds_in(condition) {
    const found = [];
    for (const [, name, y] of condition.matchAll(forwards)) found.push({ field: name, y: Number(y) });
    for (const [, y, name] of condition.matchAll(backwards)) found.push({ field: name, y: Number(y) });
    return found.filter((each) => each.field !== "time");
}

const conditions_of = ({ name, kind, spec }) =>
    kind === "criterion" ? [{ text: spec.when, label: name }]
    : kind === "window" ? [{ text: spec.lower, label: `${name}, lower edge` }, { text: spec.upper, label: `${name}, upper edge` }]
    : [];

/// [{field, y, label}] of the triggers that watch one FEM.
export function thresholds(triggers) {
    return triggers.flatMap((trigger) => conditions_of(trigger).flatMap(({ text, label }) =>
        thresholds_in(text ?? "").map((each) => ({ ...each, label }))));
}

/// Verticals of telemetry: when a trigger was met. Firings of a bisection are transfers, not events of the FEM.
export function moments(triggers) {
    return triggers.filter(({ kind }) => kind !== "bisect").flatMap(({ name, kind, firings }) =>
        firings.map((firing) => ({ x: firing.wanted_time, text: name, kind: "fired",
                                   label: `${name} (${kind}) met at ${number(firing.wanted_time)} s, ` +
                                          `snapshot at ${number(firing.transfer_time)} s` })));
}

const edge_times = (crossed) => [crossed?.lower?.time, crossed?.upper?.time];

/// [{from, to, label}]: the found windows.
export function windows(triggers) {
    return triggers.filter(({ kind }) => kind === "window").flatMap(({ name, firings }) => firings.flatMap((firing) => {
        const [from, to] = edge_times(firing.crossed);
        return Number.isFinite(from) && Number.isFinite(to) ? [{ from, to, label: name, kind: "window" }] : [];
    }));
}

/// [{from, to, label}]: the plateau of the runout found so far by a bisection.
export function plateaus(triggers) {
    return triggers.filter(({ kind, result }) => kind === "bisect" && Number.isFinite(result?.lower?.on))
        .map(({ spec, result }) => ({ from: result.lower.on, to: result.upper.on, kind: "plateau",
                                      label: `plateau, at least ${number(100 * (spec.share ?? 0.75))} % of the largest` +
                                             (result.complete ? "" : ", so far") }));
}

/// The condition of a trigger in words.
export function condition_text({ kind, spec }) {
    switch (kind) {
        case "criterion": return spec.when + (spec.hold_s ? `, held ${number(spec.hold_s)} s` : "");
        case "window": return `from ${spec.lower} to ${spec.upper}; ${spec.pick ?? "midpoint"}`;
        case "bisect": return `both edges of the plateau to ${number(spec.tolerance_s)} s`;
        case "manual": return "by hand";
        default: return "";
    }
}

function outcome(trigger) {
    const { kind, result, firings, reason } = trigger;
    if (reason) return reason;
    if (kind === "bisect") {
        if (!result) return `${firings.length} runs asked for`;
        const close = (result.straddling ?? []).map(({ transfer_time }) => number(transfer_time)).join(", ");
        return `${result.runs} runs instead of ${result.uniform_runs}` +
               (close ? `; at ${close} s the ${result.draws} repeats scatter across the level` : "");
    }
    return firings.map((firing) => `at ${number(firing.wanted_time)} s, known at step ${firing.fem_step}, ` +
                                   `snapshot ${number(firing.transfer_time)} s`).join("; ");
}

export function draw_triggers(triggers) {
    by_id("triggers").hidden = triggers.length === 0;
    mirror(by_id("trigger-rows"), triggers, (trigger) => trigger.id, () => element("tr", {}, element("th", { scope: "row" }),
           element("td"), element("td", {}, element("span")), element("td", { class: "message" }, element("code")), element("td", { class: "message" })),
           (row, trigger) => {
               const [name, kind, state, condition, what] = row.children;
               set_text(name, trigger.name || trigger.kind);
               if (kind.textContent !== trigger.kind) kind.replaceChildren(trigger.kind === "window" ? term("window", "window") : trigger.kind);
               show_state(state.firstElementChild, trigger.state);
               set_text(condition.firstElementChild, condition_text(trigger));
               set_text(what, outcome(trigger));
           });
}
