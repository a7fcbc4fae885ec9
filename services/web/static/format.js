// Numbers, times and states as text for people.

/// Four significant digits, 2.5e6 for very large and small values; "–" for missing ones.
export function number(value, digits = 4) {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    const size = Math.abs(value);
    if (size !== 0 && (size >= 1e6 || size < 1e-3)) return value.toExponential(Math.max(digits - 2, 1)).replace(/\.?0*e\+?/, "e");
    return String(Number(value.toPrecision(digits)));
}

/// Any value as one line of text, numbers to six digits.
export const short_json = (value) => JSON.stringify(value, (_, each) =>
    (typeof each === "number" ? Number(each.toPrecision(6)) : each)).replaceAll(/([:,])(?=[^\s])/g, "$1 ");

export const seconds = (value) => (Number.isFinite(value) ? `${number(value)} s` : "–");

export function bytes(count) {
    if (!Number.isFinite(count)) return "–";
    const units = ["B", "KB", "MB", "GB"];
    let unit = 0;
    while (count >= 1000 && unit < units.length - 1) {
        count /= 1000;
        unit += 1;
    }
    return `${number(count, 3)} ${units[unit]}`;
}

/// "14:03:22", with the date when it is not today's.
export function clock(iso) {
    if (!iso) return "–";
    const when = new Date(iso);
    if (Number.isNaN(when.getTime())) return iso;
    const time = when.toLocaleTimeString([], { hour12: false });
    const today = new Date().toDateString() === when.toDateString();
    return today ? time : `${when.toLocaleDateString()} ${time}`;
}

/// A duration: "4.2 s", "12 min 5 s", "3 h 20 min".
export function span(length) {
    if (length < 60) return `${length.toFixed(length < 10 ? 1 : 0)} s`;
    if (length < 3600) return `${Math.floor(length / 60)} min ${Math.floor(length % 60)} s`;
    return `${Math.floor(length / 3600)} h ${Math.floor((length % 3600) / 60)} min`;
}

/// Wall time between two moments; without the second, until now.
export function elapsed(from, to) {
    if (!from) return "–";
    return span(Math.max(0, (to ? new Date(to) : new Date()) - new Date(from)) / 1000);
}

export const percent = (fraction) => `${Math.floor(100 * Math.min(1, Math.max(0, fraction ?? 0)))} %`;

const ended = new Set(["succeeded", "questionable", "cached", "partial", "failed", "cancelled", "skipped", "not_reached", "lost"]);
export const is_active = (state) => !ended.has(state);

/// One colour family and one sign per state, so that colour is never the only mark.
export function state_look(state) {
    if (state.startsWith("ended: ")) return { family: "calm", sign: "■" };
    switch (state) {
        case "succeeded":
        case "cached":
        case "fired":
            return { family: "good", sign: "✓" };
        case "questionable":
            return { family: "warn", sign: "⚠" };
        case "partial":
        case "paused":
            return { family: "warn", sign: "◐" };
        case "failed":
        case "lost":
            return { family: "bad", sign: "✕" };
        case "cancelled":
        case "cancelling":
        case "skipped":
        case "not_reached":
        case "expired":
        case "disarmed":
            return { family: "off", sign: "⊘" };
        case "starting":
        case "running":
        case "finalizing":
        case "holding":
            return { family: "busy", sign: "▶" };
        default:
            return { family: "idle", sign: "·" };
    }
}

/// A task's state for display: a successful task may have a questionable result or a regular early end; a skipped one may be beyond its
/// FEM's regular end.
export function task_state({ state, ended: how, end_time, questionable, not_reached }) {
    if (state === "skipped" && not_reached) return "not_reached";
    if (!["succeeded", "cached"].includes(state)) return state;
    if (questionable) return "questionable";
    return how === "entangled" ? `ended: entangled at ${seconds(end_time)}` : state;
}

export function show_state(badge, state) {
    const { family, sign } = state_look(state);
    badge.className = `state ${family}`;
    const text = `${sign} ${state.replace("_", " ")}`;
    if (badge.textContent !== text) badge.textContent = text;
}

/// "t_T = 1.5 s, softened": a point of the sweep; "": shared by all points.
export function point_name({ transfer_time, variant }) {
    const time = Number.isFinite(transfer_time) ? `t_T = ${number(transfer_time)} s` : "";
    return [time, variant].filter(Boolean).join(", ");
}

/// "MPM from t_T = 1.5 s, softened"; for a filled section "MPM, softened".
export const mpm_name = (task) => (Number.isFinite(task.transfer_time) ? `MPM from ${point_name(task)}` : ["MPM", task.variant].filter(Boolean).join(", "));

/// "fem_solver", "mpm_solver, t_T = 1.5 s, softened"
export const task_name = (task) => [task.phase, point_name(task)].filter(Boolean).join(", ");

/// Names of a run's variants in the study's order; [""] when it has none.
export function variants_of(run) {
    const named = (run.study?.variants ?? []).map((variant) => variant.name);
    return named.length ? named : [""];
}

/// Sorts sweep points.
export const by_point = (variants) => (a, b) =>
    (a.transfer_time ?? -1) - (b.transfer_time ?? -1) || variants.indexOf(a.variant) - variants.indexOf(b.variant);
