// Compares two runs by numbers: different entries of their studies, and different results.
import * as api from "./api.js";
import { governing_of } from "./answer.js";
import { by_id, set_text } from "./dom.js";
import { is_active, number, point_name, short_json } from "./format.js";
import { pointer_of } from "./json_text.js";
import { key_of } from "./results.js";
import { offer_runs } from "./run_picker.js";
import { DataTable } from "./table.js";

export const differences_address = (...runs) => `#/differences/${runs.filter(Boolean).map(encodeURIComponent).join("/")}`;

const not_input = ["name", "title", "notes", "format", "priority", "resources", "reuse", "report"]; // no effect on numbers
const longest = 200; // characters of a value
const compared = { factor_of_safety: "factor of safety", factor_of_safety_liquefied: "factor of safety, liquefied", runout: "runout [m]",
                   runout_beyond_toe: "passed the toe [m]", runout_largest: "farthest [m]", area_beyond_toe: "deposit beyond the toe [m²]", depth_beyond_toe: "depth beyond the toe [m]",
                   volume_ratio: "volume ratio", numerical_share: "numerical share", cpu_seconds: "CPU [s]" };

/// Map of name -> member; null: not a container. Lists of named objects are compared by name; other lists are one value.
function members_of(value) {
    if (Array.isArray(value)) return value.length > 0 && value.every((each) => each?.name) ? new Map(value.map((each) => [each.name, each])) : null;
    return value !== null && typeof value === "object" ? new Map(Object.entries(value).filter(([name]) => !not_input.includes(name))) : null;
}

function text_of(value) {
    const text = value === undefined ? "" : short_json(value);
    return text.length > longest ? `${text.slice(0, longest)}…` : text;
}

/// [{where, left, right}]: the entries that differ, including those that one side lacks.
export function input_differences(left, right, parts = []) {
    if (JSON.stringify(left) === JSON.stringify(right)) return [];
    const [a, b] = [left, right].map(members_of);
    if (!a || !b) return [{ where: pointer_of(parts), left: text_of(left), right: text_of(right) }];
    return [...new Set([...a.keys(), ...b.keys()])].flatMap((name) => input_differences(a.get(name), b.get(name), [...parts, name]));
}

/// The study as it was sent: without the variants that the service generated.
const input_of = ({ study }) => ({ ...study, variants: (study.variants ?? []).filter(({ made_by: by }) => !by) });

/// [{point, quantity, left, right, change, percent}] of pairs of rows [point, left, right]; only differences.
export const result_differences = (pairs) => pairs.flatMap(([point, left, right]) =>
    Object.entries(compared).filter(([column]) => number(left[column]) !== number(right[column]))
        .map(([column, quantity]) => ({ point, quantity, left: left[column], right: right[column], ...change_of(left[column], right[column]) })));

function change_of(from, to) {
    if (!Number.isFinite(from) || !Number.isFinite(to)) return { change: null, percent: null };
    return { change: to - from, percent: from === 0 ? null : (100 * (to - from)) / Math.abs(from) };
}

const numeric = (name, title) => ({ name, title, number: true, cell: (record) => (Number.isFinite(record[name]) ? number(record[name]) : "–") });

export class Differences {
    constructor() {
        this.input = new DataTable(by_id("differences-input"));
        this.results = new DataTable(by_id("differences-results"));
        for (const side of [0, 1]) by_id(`differences-run-${side}`).addEventListener("change", () => {
            location.hash = differences_address(...[0, 1].map((each) => by_id(`differences-run-${each}`).value));
        });
    }

    /// ids: of two runs; without a second one the user chooses it.
    async show(ids) {
        if (this.settled === ids.join()) return;
        const [runs, ...sides] = await Promise.all([api.list_runs(), ...ids.map((id) => Promise.all([api.read_run_alone(id), api.read_results(id)]))]);
        [0, 1].forEach((side) => this.offer(side, runs, sides[side]?.[0]));
        const both = sides.length === 2;
        this.settled = sides.some(([run]) => is_active(run.state)) ? null : ids.join(); // neither changes any more
        for (const part of ["input", "results"]) by_id(`differences-${part}`).parentElement.hidden = !both;
        set_text(by_id("differences-says"), both ? "" : "Choose the second run.");
        if (!both) return;
        const [[a, of_a], [b, of_b]] = sides;
        const wide = (name, title) => ({ name, title, wide: true });
        this.input.open("input", [wide("where", "entry"), wide("left", "left"), wide("right", "right")], input_differences(input_of(a), input_of(b)));
        const tops = [[a, of_a], [b, of_b]].map(([run, { rows, means }]) => governing_of(run, rows, means).row ?? {});
        const others = new Map(of_b.rows.map((row) => [key_of(row), row]));
        const shared = of_a.rows.filter((row) => others.has(key_of(row))).map((row) => [point_name(row), row, others.get(key_of(row))]);
        this.results.open("results", [wide("point", "transfer time, variant"), wide("quantity", "quantity"), numeric("left", "left"), numeric("right", "right"),
                                      numeric("change", "change"), numeric("percent", "change [%]")], result_differences([["governing variant", ...tops], ...shared]));
        const verdicts = [a, b].map(({ verdict }, side) => `${["Left", "Right"][side]}: ${verdict.words}, governed by ${point_name(tops[side]) || "the scene itself"}`);
        const only = [of_a, of_b].map(({ rows }) => rows.length - shared.length);
        set_text(by_id("differences-says"), `${verdicts.join(". ")}. ${shared.length} results are in both, ${only[0]} only left, ${only[1]} only right.`);
    }

    offer(side, runs, run) {
        const known = !run || runs.some(({ id }) => id === run.id) ? runs : [run, ...runs];
        offer_runs(by_id(`differences-run-${side}`), known, run?.id ?? "");
    }
}
