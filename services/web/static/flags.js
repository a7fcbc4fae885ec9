// What the flags of a result mean to a person: may its number be believed, is it a bound, or is nothing known of it.
import { element } from "./dom.js";
import { number } from "./format.js";

const is_doubt = (flag) => flag.severity === "questionable";
const worded = (code) => code.replaceAll("_", " ");

/// sound | questionable
export const trust_of = ({ questionable }) => (questionable ? "questionable" : "sound");

/// How a runout's marker looks, as class names: bound (a lower bound), doubtful (questionable for another reason); "" is sound.
export function look_of(row) {
    const other = row.questionable && (row.flags ?? []).some((flag) => is_doubt(flag) && flag.code !== "still_moving");
    return [row.lower_bound ? "bound" : "", other || (row.questionable && !row.lower_bound) ? "doubtful" : ""].filter(Boolean).join(" ");
}

/// What the looks mean, for legends.
export const looks = {
    bound: "still moving: the runout is a lower bound",
    doubtful: "questionable",
};

/// "still moving; coarse cells (warning)"; "none".
export function flag_codes(flags) {
    return (flags ?? []).map((flag) => worded(flag.code) + (is_doubt(flag) ? "" : " (warning)")).join("; ") || "none";
}

/// Every flag with its message, one line each.
export function flag_note({ flags }) {
    return (flags ?? []).map((flag) => `${worded(flag.code)}: ${flag.message}`).join("\n");
}

/// Whether the soil had come to rest; how much of the released energy was still in its motion.
export function rest_text({ at_rest, kinetic_share }) {
    if (at_rest === true) return "at rest";
    if (at_rest !== false) return "not known";
    return Number.isFinite(kinetic_share) ? `moving, ${number(100 * kinetic_share, 2)} % in motion` : "moving";
}

/// What must be known of a picture of a task, in a sentence; row: its results, if it has any. "" when nothing is to be said.
export function picture_verdict({ phase, state, ended, end_time }, row) {
    if (["running", "starting", "finalizing"].includes(state)) return "Still running: more snapshots will come.";
    if (phase === "fem_solver") return ended === "entangled" ? `The mesh entangled at ${number(end_time)} s: there is no later state.` : "";
    if (!row || row.at_rest === true) return "";
    if (row.at_rest === false) return `Not at rest at the end (${rest_text(row)}): the last picture is no final deposit.`;
    return "Whether the soil came to rest is not known.";
}

/// Flags as a list with messages and places, questionable ones first.
export function flag_items(flags) {
    const order = [...flags].sort((a, b) => is_doubt(b) - is_doubt(a));
    return order.map((flag) => element("li", {}, element("span", { class: `state ${is_doubt(flag) ? "warn" : "calm"}` },
        `${is_doubt(flag) ? "⚠ " : ""}${worded(flag.code)}`), ` ${flag.message} `, flag.pointer ? element("code", {}, flag.pointer) : null));
}

/// "7 × still moving · 8 × implausible", the most frequent first.
export function counts_text(counts) {
    return Object.entries(counts ?? {}).sort((a, b) => b[1] - a[1]).map(([code, count]) => `${count} × ${worded(code)}`).join(" · ");
}
