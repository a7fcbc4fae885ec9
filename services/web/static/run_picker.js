// The choice of a run in a view of one or two: name, date, and how far its results can be used.
import { element, mirror, set_text } from "./dom.js";
import { clock, is_active } from "./format.js";

/// The state until the run ends well, then the verdict: a good run may have results that are not usable.
export const has_verdict = ({ state }) => ["succeeded", "questionable"].includes(state);
export const shown_state = ({ state, paused }) => (paused && is_active(state) ? "paused" : state);

/// chosen: its id; "": none yet.
export function offer_runs(select, runs, chosen) {
    mirror(select, [...(chosen ? [] : [{ id: "" }]), ...runs], ({ id }) => id, ({ id }) => element("option", { value: id }), (option, run) =>
        set_text(option, run.id ? `${run.title || run.name}, ${clock(run.created)}: ${has_verdict(run) ? run.verdict.words : shown_state(run).replace("_", " ")}` : "choose…"));
    select.value = chosen;
}
