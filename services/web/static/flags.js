// The meaning of a result's flags: whether a number is reliable, a lower bound, or unknown.
import { element } from "./dom.js";
import { term } from "./glossary.js";
import { number } from "./format.js";

const is_doubt = (flag) => flag.severity === "questionable";
const worded = (code) => code.replaceAll("_", " ");

/// sound | questionable
export const trust_of = ({ questionable }) => (questionable ? "questionable" : "sound");

/// Class names of a runout's marker: bound (a lower bound), doubtful (questionable for another reason); "": sound.
export function look_of(row) {
    const other = row.questionable && (row.flags ?? []).some((flag) => is_doubt(flag) && flag.code !== "still_moving");
    return [row.lower_bound ? "bound" : "", other || (row.questionable && !row.lower_bound) ? "doubtful" : ""].filter(Boolean).join(" ");
}

/// Meaning of the class names, for legends.
export const looks = {
    bound: "still moving: the runout is a lower bound",
    doubtful: "questionable",
};

/// One entry per code and severity, the worst first: {code, severity, count, flags}.
function kinds_of(flags) {
    const kinds = Map.groupBy([...flags].sort((a, b) => is_doubt(b) - is_doubt(a)), ({ code, severity }) => `${severity} ${code}`);
    return [...kinds.values()].map((some) => ({ ...some[0], flags: some, count: some.length }));
}

const counted = (code, count) => worded(code) + (count > 1 ? ` × ${count}` : "");

/// "still moving; coarse elements × 11; 2 warnings"; "none".
export function flag_codes(flags) {
    const kinds = kinds_of(flags ?? []);
    const warnings = kinds.filter((kind) => !is_doubt(kind)).length;
    return [...kinds.filter(is_doubt).map(({ code, count }) => counted(code, count)), warnings ? `${warnings} warning${warnings > 1 ? "s" : ""}` : ""]
        .filter(Boolean).join("; ") || "none";
}

/// Every flag with its message, one line each.
export function flag_note({ flags }) {
    return (flags ?? []).map((flag) => `${worded(flag.code)}: ${flag.message}`).join("\n");
}

/// Whether the soil was at rest, and the share of the released energy still in motion.
export function rest_text({ at_rest, kinetic_share }) {
    if (at_rest === true) return "at rest";
    if (at_rest !== false) return "not known";
    return Number.isFinite(kinetic_share) ? `moving, ${number(100 * kinetic_share, 2)} % in motion` : "moving";
}

/// A caution about a picture of a task, in a sentence; row: its results, if any. "": none.
export function picture_verdict({ phase, state, ended, end_time }, row) {
    if (["running", "starting", "finalizing"].includes(state)) return "Still running: more snapshots will come.";
    if (phase === "fem_solver") return ended === "entangled" ? `The mesh entangled at ${number(end_time)} s: there is no later state.` : "";
    if (!row || row.at_rest === true) return "";
    if (row.at_rest === false) return `Not at rest at the end (${rest_text(row)}): the last picture is no final deposit.`;
    return "Whether the soil came to rest is not known.";
}

/// Flags that the glossary explains.
const explained = { entangled: "entangled", numerical_share: "numerical-share", overlap: "overlap", still_moving: "lower-bound", volume_ratio: "volume-ratio" };
const badge = (family, text) => element("span", { class: `state ${family}` }, family === "calm" ? "" : "⚠ ", text);

/// One line per kind, with its full text and other messages when opened. texts: [{text, pointer}]
function line_of(family, name, code, [first, ...others]) {
    const place = (pointer) => (pointer ? element("code", {}, pointer) : null);
    const anchor = explained[code];
    return element("li", {}, badge(family, anchor ? term(anchor, name) : name), " ", element("details", {}, element("summary", {}, first.text), place(first.pointer),
        ...others.map(({ text, pointer }) => element("p", {}, `${text} `, place(pointer)))));
}

/// Flags as a list, one line per kind, questionable ones first.
export const flag_items = (flags) => kinds_of(flags).map((kind) =>
    line_of(is_doubt(kind) ? "warn" : "calm", counted(kind.code, kind.count), kind.code, kind.flags.map(({ message, pointer }) => ({ text: message, pointer }))));

/// Class of a verdict and its reasons; usable: from the findings.
export const verdict_look = (usable) => ({ no: "bad", questionable: "warn", in_part: "warn", with_remarks: "calm", yes: "good" })[usable] ?? "off";

export const verdict_sign = (usable) => ({ no: "✕", questionable: "⚠", in_part: "◐", with_remarks: "✓", yes: "✓" })[usable] ?? "·";

/// The reasons of a verdict, worst first, one line per kind. flags: an object with the flags' codes as members.
export function reason_items({ reasons }, flags) {
    const kinds = Map.groupBy(reasons, ({ usable, code }) => `${usable} ${code}`);
    return [...kinds.values()].map((some) => {
        const [{ usable, code }] = some;
        const count = Math.max(...some.map((each) => each.count)); // the same results may have several
        return { key: `${usable} ${code} ${some.map(({ text }) => text).join()}`,
                 make: () => line_of(verdict_look(usable), counted(code, count), code, some.map(({ text, pointer }) => ({ text: code in flags ? without_name(text, code) : text, pointer }))) };
    });
}

/// Removes a flag's name that is already in front of the text.
function without_name(text, code) {
    const name = `${worded(code)}, `;
    return text.toLowerCase().startsWith(name) ? text.slice(name.length) : text;
}

/// "still moving × 7 · implausible × 8", the most frequent first.
export function counts_text(counts) {
    return Object.entries(counts ?? {}).sort((a, b) => b[1] - a[1]).map(([code, count]) => counted(code, count)).join(" · ");
}
