// Runout against transfer time: one curve per variant, window and plateau of the triggers, table, CSV.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { flag_codes, flag_note, look_of, rest_text, trust_of } from "./flags.js";
import { by_point, is_active, number, point_name, show_state, state_look, variants_of } from "./format.js";
import { draws_of, mean_rows } from "./means.js";
import { parameters_of } from "./parameters.js";
import { Plot } from "./plot.js";
import { plateaus, windows } from "./triggers.js";

export const measures = {
    runout: "99 % of the mobile soil",
    runout_beyond_toe: "99 % of what passed the toe",
    runout_largest: "farthest point",
    factor_of_safety: "factor of safety",
    factor_of_safety_liquefied: "factor of safety, liquefied",
    factor_of_safety_post_seismic: "factor of safety after shaking",
};
const of_runout = ["runout", "runout_beyond_toe", "runout_largest", "volume_ratio", "numerical_share", "overlap"];
const is_safety = (column) => column.startsWith("factor_of_safety");
const columns = [...of_runout, "factor_of_safety", "factor_of_safety_liquefied", "cpu_seconds"];
const unit_of = (measure) => (is_safety(measure) ? "" : "m");
const y_label_of = (measure) => (is_safety(measure) ? "factor of safety [–]" : "runout from the toe [m]");

/// Hidden where the table has no room, until the user shows all.
const folded = new Set(["runout_largest", "volume_ratio", "overlap"]);

export class Results {
    /// look_at(row): called to show this point's particles. ask(row, column): called to show where its numbers come from.
    constructor({ look_at, ask }) {
        Object.assign(this, { look_at, ask, rows: [], means: [], of_mean: null });
        this.plot = new Plot(by_id("runout-plot"), {
            title: "Runout", x: "transfer time t_T [s]", y: "runout from the toe [m]", x_name: "t_T", x_unit: "s",
            hint: "Point at the curve, or use the arrow keys; click or Enter shows where the number comes from.",
        }, { height: 340, y_from_zero: true, choose: (_, key) => key && this.trace(this.row(key), this.measure()) });
        by_id("runout-draws").addEventListener("change", () => {
            this.of_mean = null;
            this.refresh();
        });
        by_id("runout-measure").addEventListener("change", () => this.draw());
        by_id("runout-abscissa").addEventListener("change", () => this.refresh());
        by_id("runout-all").addEventListener("change", (event) => by_id("runout-table").classList.toggle("all", event.target.checked));
        by_id("runout-trust").addEventListener("change", () => this.refresh());
        by_id("runout-rows").addEventListener("click", (event) => {
            const cell = event.target.closest("[data-column]");
            if (cell) this.trace(this.row(cell.parentElement.dataset.key), cell.dataset.column);
        });
    }

    /// Shows where a number comes from; for a mean, its repeats.
    trace(row, column) {
        if (!row?.mean) {
            this.ask(row, column);
            return;
        }
        this.of_mean = row;
        by_id("runout-draws").value = "runs";
        this.refresh();
    }

    shows_means() {
        return this.means.length > 0 && by_id("runout-draws").value === "means";
    }

    /// In a study with repeats: the means, all repeats, or those of one mean.
    chosen() {
        if (this.shows_means()) return this.means;
        return this.of_mean ? draws_of(this.of_mean, this.rows, this.run.study) : this.rows;
    }

    shown_variants() {
        return this.shows_means() ? [...new Set(this.means.map(({ variant }) => variant))] : this.variants;
    }

    measure() {
        return by_id("runout-measure").value;
    }

    row(key) {
        return [...(this.shows_means() ? this.means : []), ...this.rows].find((row) => key_of(row) === key);
    }

    /// Returns the rows for other views.
    show(run, { rows, means, without_transfer: without }) {
        if (this.run?.id !== run.id) {
            this.of_mean = null;
            by_id("runout-draws").value = "means";
        }
        this.means = mean_rows(means ?? []);
        by_id("runout-draws-label").hidden = this.means.length === 0;
        this.run = run;
        this.variants = variants_of(run);
        this.rows = rows.sort(by_point(this.variants));
        by_id("runouts").hidden = Boolean(run.study?.uncertainty); // the uncertainty view shows its samples
        if (by_id("runouts").hidden) return this.rows;
        this.offer_what_there_is();
        this.offer_parameters();
        this.refresh();
        const finished = rows.filter(is_finished).length;
        const several = this.variants.length > 1;
        const what = this.is_static() ? (several ? "variants" : "runs")
            : several ? `runs (transfer times × ${this.variants.length} variants)` : "transfer times";
        const draws = this.means[0]?.draws;
        set_text(by_id("runout-progress"), `${finished} of ${rows.length} ${draws ? `runs (${draws} repeats each)` : what} finished`);
        by_id("runout-plot").hidden = rows.length < 2; // a single number is in the head
        by_id("runout-table").parentElement.hidden = rows.length === 0 && without?.length > 0;
        return this.rows;
    }

    /// Without a FEM there are no transfer times: the abscissa has the variants.
    is_static() {
        return !this.run.tasks.some(({ phase }) => phase === "fem_solver" || phase === "transfer_tool");
    }

    /// Offers only measures that the run has: no runout for a stability analysis alone, no factor of safety without one.
    offer_what_there_is() {
        const has = (phase) => this.run.tasks.some((task) => task.phase === phase);
        const has_some = (column) => this.rows.some((row) => Number.isFinite(row[column]));
        const offered = (measure) => (measure === "factor_of_safety" ? has("lem_tool")
            : is_safety(measure) ? has_some(measure) : has("mpm_solver") || !has("lem_tool"));
        const select = by_id("runout-measure");
        for (const option of select.options) option.hidden = option.disabled = !offered(option.value);
        if (!offered(select.value)) select.value = Object.keys(measures).find(offered);
        const shown = by_id("runout-table").classList;
        shown.toggle("no-safety", !offered("factor_of_safety"));
        shown.toggle("no-liquefied", !offered("factor_of_safety_liquefied"));
        shown.toggle("no-runout", !offered("runout"));
        shown.toggle("no-time", this.is_static());
    }

    /// Offers the numeric differences between variants as abscissas.
    offer_parameters() {
        this.parameters = parameters_of(this.run.study);
        const select = by_id("runout-abscissa");
        const before = select.value;
        const plain = this.is_static() ? "variant" : "transfer time";
        mirror(select, [{ pointer: "" }, ...this.parameters], ({ pointer }) => pointer, ({ pointer }) => element("option", { value: pointer }),
               (option, { pointer }) => set_text(option, pointer || plain));
        select.value = this.parameters.some(({ pointer }) => pointer === before) ? before : "";
        by_id("runout-abscissa-label").hidden = this.parameters.length === 0;
    }

    parameter() {
        return this.parameters.find(({ pointer }) => pointer === by_id("runout-abscissa").value);
    }

    /// The rows to show: all, or without finished ones that are not sound.
    shown() {
        if (by_id("runout-trust").value === "all") return this.chosen();
        return this.chosen().filter((row) => !is_finished(row) || trust_of(row) === "sound");
    }

    refresh() {
        const chosen = this.chosen();
        by_id("runout-table").classList.toggle("one-variant", this.shown_variants().length < 2);
        by_id("runout-csv").href = api.results_csv(this.run.id, this.shows_means());
        const hidden = chosen.length - this.shown().length;
        const note = [this.of_mean ? `Only the repeats of ${point_name(this.of_mean)}.` : "", hidden ? `${hidden} not shown.` : "", this.unplaced_note()]
            .filter(Boolean).join(" ");
        by_id("runout-note").hidden = !note;
        set_text(by_id("runout-note"), note);
        mirror(by_id("runout-rows"), this.shown(), key_of, () => this.new_row(), fill_row);
        this.draw();
    }

    /// Names the variants that have no place on a parameter's axis.
    unplaced_note() {
        const parameter = this.parameter();
        const without = parameter ? this.shown_variants().filter((variant) => parameter.value_of(variant) === null) : [];
        return without.length === 0 ? "" : `Not in the figure, because neither they nor the scene that was sent give ${parameter.pointer} as a number: ` +
            `${without.map((variant) => variant || "the scene itself").join(", ")}.`;
    }

    /// One colour and one shape per variant, over the parameter.
    draw_against({ pointer, value_of }, lines, points, marks, errors_name) {
        const placed = lines.filter(({ variant }) => value_of(variant) !== null);
        this.plot.labels.x_name = pointer.split("/").at(-1);
        this.plot.labels.x_unit = "";
        this.plot.show({
            series: placed.map(({ variant, rows }) => ({ name: variant || this.run.name, scatter: true, ...points(rows),
                                                         names: rows.map((row) => point_name({ ...row, variant: "" })),
                                                         x: rows.map(() => value_of(variant)) })),
            marks: marks.filter((row) => value_of(row.variant) !== null).map((row) => ({ ...mark_of(row, true), x: value_of(row.variant) })),
            x_label: pointer, errors_name,
        });
    }

    draw() {
        const measure = this.measure();
        const variants = this.shown_variants();
        const several = variants.length > 1;
        const rows = this.shown();
        const lines = series_by_variant(rows, variants);
        this.plot.labels.y = y_label_of(measure);
        const points = (some) => ({ unit: unit_of(measure), points: true, keys: some.map(key_of), y: some.map((row) => row[measure] ?? null),
                                    errors: some.map((row) => error_of(row, measure)), looks: some.map((row) => look_of_measure(row, measure)), notes: some.map((row) => note_of(row, measure)) });
        const marks = rows.filter((row) => !is_finished(row));
        const errors_name = this.shows_means() ? "standard deviation of the repeats" : "error of one run";
        const what = is_safety(measure) ? "Factor of safety" : "Runout";
        const parameter = this.parameter();
        if (parameter) {
            set_text(by_id("runout-title"), `${what} against a parameter`);
            this.draw_against(parameter, lines, points, marks, errors_name);
            return;
        }
        Object.assign(this.plot.labels, { x_name: "t_T", x_unit: "s" });
        const side_by_side = this.is_static() || (several && lines.length > 1 && new Set(rows.map((row) => row.transfer_time)).size === 1);
        set_text(by_id("runout-title"), what + (!side_by_side ? " against transfer time" : several ? " by variant" : ""));
        if (side_by_side) {
            // One transfer time: the abscissa has the variants.
            const at = (row) => lines.findIndex(({ variant }) => variant === row.variant);
            this.plot.show({
                series: [{ name: [measures[measure], point_name({ ...rows[0], variant: "" })].filter(Boolean).join(", "), scatter: true,
                           ...points(rows), x: rows.map(at) }],
                marks: marks.map((row) => ({ ...mark_of(row, several), x: at(row) })),
                names: lines.map(({ variant }, x) => ({ x, label: variant || this.run.name })), x_label: several ? "variant" : " ", errors_name,
            });
            return;
        }
        this.plot.show({
            series: lines.map(({ variant, rows: some }) => ({ name: several ? variant : measures[measure], ...points(some),
                                                              x: some.map((row) => row.transfer_time) })),
            marks: marks.map((row) => mark_of(row, several)),
            bands: [...windows(this.run.triggers), ...plateaus(this.run.triggers)], errors_name,
        });
    }

    new_row() {
        const look = element("button", { type: "button", class: "link", onclick: () => this.look_at(this.row(row.dataset.key)) });
        const ask = element("button", { type: "button", class: "link", onclick: () => this.trace(this.row(row.dataset.key), "runout") }, "trace");
        const row = element("tr", {}, element("th", { scope: "row" }, look), element("td", { class: "variant" }),
                            element("td", {}, element("span")));
        for (const column of columns) {
            const kind = of_runout.includes(column) ? "of-runout" : is_safety(column) ? "safety" : "";
            const liquefied = column === "factor_of_safety_liquefied" ? "liquefied" : "";
            row.append(element("td", { class: ["number", folded.has(column) ? "fold" : "", kind, liquefied].filter(Boolean).join(" "),
                                       "data-column": column, title: "Where this number comes from" }));
            if (column === "runout") row.append(element("td", { class: "rest of-runout" }), element("td", { class: "flag-codes" }));
        }
        row.append(element("td", { class: "fold time" }), element("td", {}, ask));
        return row;
    }
}

export const key_of = (row) => `${row.transfer_time}/${row.variant}${row.mean ? "/mean" : ""}`;

/// A row may have a factor of safety before its runout.
const is_finished = (row) => Number.isFinite(row.runout) || (Number.isFinite(row.factor_of_safety) && !row.transfer_task &&
                                                            ["succeeded", "questionable"].includes(row.state));

/// Error of a measure: an accuracy study names its quantity; otherwise the error is that of the runout. For a mean, the scatter of its
/// repeats.
function error_of(row, measure) {
    if (row.mean) return row[`${measure}_deviation`] ?? null;
    const judged = /: of (\w+)/.exec(row.runout_error_from ?? "")?.[1] ?? "runout";
    return judged === measure ? row.runout_error ?? null : null;
}

/// Caution about a point's number.
function note_of(row, measure) {
    if (!is_finished(row)) return "";
    const error = error_of(row, measure);
    if (row.mean) return mean_note(row, measure, error);
    const off = error === null ? "" : `± ${number(error, 2)} m: ${row.runout_error_from}`;
    const rest = Number.isFinite(row.runout) ? rest_text(row) : "";
    return [[`${point_name(row) || measures[measure]}: ${number(row[measure])} ${unit_of(measure)}`.trim(), rest].filter(Boolean).join(", "), off,
            flag_note(row)].filter(Boolean).join("\n");
}

/// A factor of safety is not a lower bound, even if the row's runout is.
const look_of_measure = (row, measure) => (is_safety(measure) ? look_of(row).replace(/\bbound\b/, "").trim() : look_of(row));

function mean_note(row, measure, deviation) {
    const unit = is_safety(measure) ? "" : " m";
    const scatter = deviation === null ? "" : `, one draw scatters by ${number(deviation, 2)}${unit} (standard deviation)`;
    const off = measure === "runout" && Number.isFinite(row.runout_error)
        ? `the mean may be off by ${number(row.runout_error, 2)} m: ${row.runout_error_from}` : "";
    return [`${point_name(row) || "all repeats"}: ${number(row[measure])}${unit}, mean of ${row.draws_done} of ${row.draws} repeats${scatter}`, off, flag_note(row)]
        .filter(Boolean).join("\n");
}

/// [{variant, rows}] in the study's order, rows in order of time.
export function series_by_variant(rows, variants) {
    const known = [...variants, ...new Set(rows.map((row) => row.variant).filter((name) => !variants.includes(name)))];
    return known.map((variant) => ({ variant, rows: rows.filter((row) => row.variant === variant) }))
        .filter((series) => series.rows.length > 0);
}

function mark_of(row, several) {
    const kinds = { failed: "failed", lost: "failed", skipped: "skipped", not_reached: "skipped", cancelled: "skipped", cancelling: "skipped" };
    const busy = state_look(row.state).family === "busy" ? "running" : "pending";
    return { x: row.transfer_time, kind: kinds[row.state] ?? busy,
             label: [several ? row.variant : "", row.state.replace("_", " "), row.reason].filter(Boolean).join(": ") };
}

/// "12.5"; for a mean "12.5 ± 0.3".
function cell_text(values, column) {
    const deviation = values.mean ? values[`${column}_deviation`] : null;
    return number(values[column], is_safety(column) ? 3 : 4) + (Number.isFinite(deviation) ? ` ± ${number(deviation, 2)}` : "");
}

function fill_row(row, values) {
    const [time, variant, state] = row.children;
    const look = time.firstElementChild;
    const is_static = !Number.isFinite(values.transfer_time);
    set_text(look, is_static ? values.variant || "–" : number(values.transfer_time));
    look.disabled = !values.mpm_task || ["blocked", "ready", "skipped", "not_reached"].includes(values.state) ||
                    (is_finished(values) && !Number.isFinite(values.runout));
    look.title = "Show the particles";
    set_text(variant, values.variant);
    show_state(state.firstElementChild, values.reused && values.state === "succeeded" ? "cached" : values.state);
    state.title = [values.reason, values.state === "questionable" ? flag_note(values) : ""].filter(Boolean).join("\n");
    for (const cell of row.querySelectorAll("[data-column]")) set_text(cell, cell_text(values, cell.dataset.column));
    const bound = is_finished(values) && look_of(values).includes("bound");
    if (bound) set_text(row.querySelector('[data-column="runout"]'), `≥ ${number(values.runout)}`);
    const [rest, flags] = [row.querySelector(".rest"), row.querySelector(".flag-codes")];
    set_text(rest, Number.isFinite(values.runout) && !values.mean ? rest_text(values) : "–");
    set_text(flags, is_finished(values) ? flag_codes(values.flags) : "–");
    flags.title = is_finished(values) ? flag_note(values) : "";
    row.dataset.trust = is_finished(values) ? trust_of(values) : "";
    set_text(row.children[row.children.length - 2], values.trigger === "at_time" ? "study" : values.trigger ?? "");
    const trace = values.mean ? "repeats" : "trace";
    set_text(row.lastElementChild.firstElementChild, trace);
    row.lastElementChild.firstElementChild.setAttribute("aria-label", [`${trace}: where the numbers`, point_name(values) && `at ${point_name(values)}`,
                                                                      "come from"].filter(Boolean).join(" "));
    row.classList.toggle("waiting", is_active(values.state));
}
