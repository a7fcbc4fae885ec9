// A study over distributions: probabilities, importance of parameters, values along x, all samples; each number with its basis.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { flag_note, look_of } from "./flags.js";
import { is_active, number, show_state } from "./format.js";
import { Plot } from "./plot.js";
import { measures } from "./results.js";
import { DataTable } from "./table.js";
import { Tornado } from "./tornado.js";

const along_x = { largest_depth: "largest depth", largest_velocity: "largest velocity", largest_momentum_flux: "largest h v²", arrival: "first arrival",
                  time_of_peak: "time of the largest depth", final_depth: "final deposit" };
const long_span = 5; // ratio of the largest to the least value from which a parameter's axis is logarithmic
const golden = 0.618033988749895;

const labelled = ({ name, unit }) => `${name}${unit ? ` [${unit}]` : ""}`;
const share = (value) => `${number(100 * value, 2)} %`;
const has_result = (row) => Object.values(row.results ?? {}).some(Number.isFinite);
const plural = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;

export class Uncertainty {
    /// open_task(id): called to show the task of a sample; ask(sample): called to show where its numbers come from.
    constructor({ open_task, ask }) {
        Object.assign(this, { open_task, ask });
        this.exceedance = new Plot(by_id("uncertainty-exceedance"), { title: "Probability of more", x: "", y: "probability of more [–]", x_name: "more than", x_unit: "" }, { y_from_zero: true });
        this.tornado = new Tornado(by_id("uncertainty-tornado"));
        this.envelope = new Plot(by_id("uncertainty-envelope"), { title: "Along x", x: "x [m]", y: "", x_name: "x", x_unit: "m" });
        this.scatter = new Plot(by_id("uncertainty-scatter"), { title: "Samples", x: "", y: "", x_name: "", x_unit: "",
            hint: "One marker per sample; a click or Enter opens the task behind it." }, { choose: (_, sample) => sample && this.open(sample) });
        this.search = new Plot(by_id("uncertainty-steps"), { title: "Back-analysis", x: "", y: "", x_name: "", x_unit: "" });
        for (const id of ["quantity", "parameter", "column"]) by_id(`uncertainty-${id}`).addEventListener("change", () => this.draw());
    }

    /// rows: the results of the run, with the end of each sample.
    async show(run, rows) {
        const is_one = Boolean(run.study?.uncertainty);
        by_id("uncertainty").hidden = !is_one;
        if (!is_one) {
            this.seen = null;
            return;
        }
        const ended = run.tasks.filter(({ state }) => !is_active(state)).length;
        const seen = `${run.id} ${ended} ${run.state}`;
        if (seen === this.seen) return; // nothing has ended since
        const [answer, envelopes] = await Promise.all([api.read_uncertainty(run.id), api.read_envelopes(run.id)]);
        if (this.run?.id !== run.id) this.forget();
        Object.assign(this, { run, answer, envelopes, seen, results: new Map(rows.map((row) => [row.variant, row])) });
        this.draw();
    }

    /// {p10, p50, p90} of a run's runout; null: unknown.
    quantiles_of_runout(id) {
        const known = this.run?.id === id ? this.answer.quantities.runout?.percentiles : null;
        const [p10, p50, p90] = [10, 50, 90].map((p) => Array.isArray(known) && known.find((each) => each.p === p)?.value);
        return [p10, p50, p90].every(Number.isFinite) ? { p10, p50, p90 } : null;
    }

    forget() {
        for (const id of ["quantity", "parameter", "column"]) by_id(`uncertainty-${id}`).replaceChildren();
    }

    open(sample) {
        const task = this.answer.rows.find((row) => row.sample === sample)?.task;
        if (task) this.open_task(task);
    }

    /// A quantity that does not grow while soil moves is not a lower bound.
    look_of_quantity(row) {
        return this.grows ? this.look(row) : this.look(row).replace(/\bbound\b/, "").trim();
    }

    /// The look of a sample's number; "": sound.
    look(row) {
        const result = this.results.get(row.sample);
        return result && has_result(row) ? look_of(result) : "";
    }

    draw() {
        const { answer } = this;
        const named = Object.entries(answer.quantities).map(([value, each]) => ({ ...each, value, name: measures[value] ?? value, unit: each.unit === "1" ? "" : each.unit }));
        offer(by_id("uncertainty-quantity"), named.map(({ value, name, label }) => ({ value, text: name, title: label })), answer.quantity);
        offer(by_id("uncertainty-parameter"), answer.parameters.map(({ name }) => ({ value: name, text: name })), answer.parameters[0]?.name);
        this.quantity = by_id("uncertainty-quantity").value || answer.quantity;
        const { grows = true, bound_from = null } = answer.quantities[this.quantity] ?? {}; // a search has none
        Object.assign(this, { grows, bound_from });
        for (const kind of ["csv", "hdf5"]) by_id(`uncertainty-${kind}`).href = api.uncertainty_file(this.run.id, kind);
        this.draw_counts();
        const quantity = named.find(({ value }) => value === this.quantity); // undefined: the samples are steps of a search
        by_id("uncertainty-figures").hidden = !quantity;
        by_id("uncertainty-search").hidden = !answer.inverse;
        by_id("uncertainty-quantity").parentElement.hidden = Boolean(answer.inverse);
        if (answer.inverse) this.draw_search(answer.inverse);
        if (quantity) {
            this.draw_percentiles(quantity);
            this.draw_exceedance(quantity);
            this.draw_tornado(quantity);
            draw_importance(quantity, this.bounds_note());
            this.draw_scatter(quantity);
        }
        this.draw_envelope();
        this.draw_samples(quantity);
    }

    /// The number of samples, and findings that the numbers do not show.
    draw_counts() {
        const { samples, sentences, cautions, until } = this.answer;
        set_text(by_id("uncertainty-counts"), `${samples.done} of ${plural(samples.planned, "sample")} ended with a result`);
        const said = [...sentences,
                      ...(until?.reached ? [`p${until.percentile} is known to ± ${share(until.now)} of its value; ± ${share(until.half_width)} was asked.`] : [])];
        by_id("uncertainty-doubts").hidden = cautions.length === 0;
        for (const [id, lines] of [["uncertainty-doubts", cautions], ["uncertainty-said", said]]) {
            mirror(by_id(id), lines, (line) => line, () => element("li"), set_text);
        }
        by_id("uncertainty-left-out").hidden = samples.left_out.length === 0;
        set_text(by_id("uncertainty-left-out-title"), `Left out: ${plural(samples.left_out.length, "sample")}`);
        mirror(by_id("uncertainty-left-out-list"), samples.left_out, ({ sample }) => sample, ({ sample }) => element("li", {},
            element("button", { type: "button", class: "link", onclick: () => this.open(sample) }, sample), element("span")), (item, { state, reason }) =>
            set_text(item.lastElementChild, ` ${state}${reason ? `: ${reason}` : ""}`));
    }

    /// Whether a percentile is a lower bound: at or above the least lower bound of the samples.
    is_bound(value) {
        return this.bound_from !== null && this.bound_from <= value;
    }

    draw_percentiles({ percentiles, percentiles_lacking, unit, count, of, mean, sd }) {
        const refused = percentiles.refused ?? "";
        by_id("uncertainty-refused").hidden = !refused;
        set_text(by_id("uncertainty-refused"), refused);
        by_id("uncertainty-percentiles").hidden = Boolean(refused);
        if (refused) return;
        set_text(by_id("uncertainty-percentiles-caption"), `${count} of ${of} samples; mean ${this.at_least(mean, true)} ${unit}, standard deviation ${number(sd, 3)} ${unit}`);
        const all = [...percentiles, ...percentiles_lacking].sort((a, b) => a.p - b.p);
        mirror(by_id("uncertainty-percentile-rows"), all, ({ p }) => p, () => element("tr", {}, element("th", { scope: "row" }),
               element("td", { class: "number" }), element("td", { class: "number" })), (row, { p, value, low, high, needs }) => {
            set_text(row.children[0], `p${p}`);
            set_text(row.children[1], Number.isFinite(value) ? `${this.at_least(value)} ${unit}` : "–");
            set_text(row.children[2], Number.isFinite(low) ? `${this.at_least(low)} to ${this.at_least(high)}` : `${count} samples are not enough: ${needs} are needed`);
            row.classList.toggle("waiting", !Number.isFinite(value));
            row.children[1].title = this.is_bound(value) ? "A lower bound: samples below it were stopped while their soil still moved" : "";
        });
    }

    /// Fits and rankings use lower bounds as values.
    bounds_note() {
        return this.bound_from === null ? "" : ` ${this.answer.samples.moving} of the samples behind it are lower bounds, taken as they are.`;
    }

    at_least(value, of_all = false) {
        return `${(of_all ? this.bound_from !== null : this.is_bound(value)) ? "≥ " : ""}${number(value)}`;
    }

    draw_exceedance({ exceedance, count, of, ...quantity }) {
        const steps = in_steps(exceedance);
        const bound = this.bound_from !== null ? [{ from: this.bound_from, to: Math.max(...steps.x), label: "at least", kind: "lower-bound" }] : [];
        this.exceedance.labels.x_unit = quantity.unit;
        this.exceedance.show({
            series: [{ name: `${count} of ${of} samples`, ...steps }],
            x_label: labelled(quantity), errors_name: "90 % interval", bands: bound,
        });
    }

    draw_tornado({ tornado, ...quantity }) {
        by_id("uncertainty-tornado").hidden = Boolean(tornado.refused);
        set_text(by_id("uncertainty-tornado-note"), tornado.refused ? `No tornado: ${tornado.refused}. A surrogate that does not predict the samples left out of it says nothing of one parameter alone.`
            : `From a fitted surrogate (Q² = ${number(tornado.q2, 2)} by cross-validation), the other parameters at their medians: ${number(tornado.at_median)} ${quantity.unit}.${this.bounds_note()}`);
        if (!tornado.refused) this.tornado.show(tornado, labelled(quantity));
    }

    /// The computed values, each with the least and the largest result over its lattices.
    draw_search({ vary, quantity, unit, target, value, low, high, steps, bound }) {
        const done = steps.filter(({ result }) => Number.isFinite(result));
        const what = labelled({ name: measures[quantity] ?? quantity, unit });
        const found = Number.isFinite(value) ? [{ x: value, text: `${{ at_least: "≥ ", at_most: "≤ " }[bound] ?? ""}${number(value, 3)}` }] : [];
        Object.assign(this.search.labels, { title: `${what} against ${vary}`, y: what, x_name: vary });
        this.search.show({
            series: [{ name: "mean of the lattices", unit, points: true, x: done.map((each) => each.value), y: done.map(({ result }) => result),
                       low: done.map(({ results }) => Math.min(...results)), high: done.map(({ results }) => Math.max(...results)),
                       looks: done.map(({ lower_bounds: moving }) => (moving ? "bound" : "")),
                       notes: done.map(({ results, lower_bounds: moving }) => `${plural(results.length, "lattice")}${moving ? `, ${moving} of them lower bounds: their soil still moved` : ""}`) }],
            errors_name: "least to largest of the lattices", levels: [{ y: target, label: "asked" }], lines: found,
            bands: Number.isFinite(low) ? [{ from: low, to: high, label: "90 % by the scatter of lattices alone", kind: "interval" }] : [],
            x_label: vary, x_log: done.length > 1 && done[0].value > 0,
        });
        mirror(by_id("uncertainty-found"), this.answer.sentences, (line) => line, () => element("li"), set_text);
    }

    /// Spreads the values of choices and lattices, so that each point can be selected.
    draw_scatter(quantity) {
        const parameter = this.answer.parameters.find(({ name }) => name === by_id("uncertainty-parameter").value);
        if (!parameter) return;
        const rows = this.answer.rows.filter((row) => Number.isFinite(row.results?.[this.quantity]));
        const values = rows.map((row) => row.values[parameter.name]);
        const is_choice = ["choice", "numerical"].includes(parameter.kind);
        const options = is_choice ? [...new Set(values)].sort((a, b) => String(a).localeCompare(String(b), undefined, { numeric: true })) : [];
        const x = is_choice ? values.map((value, i) => options.indexOf(value) + 0.6 * (((i + 1) * golden) % 1) - 0.3) : values;
        const log = !is_choice && Math.min(...x) > 0 && Math.max(...x) > long_span * Math.min(...x);
        Object.assign(this.scatter.labels, { title: `${quantity.name} against ${parameter.name}`, y: labelled(quantity), x_name: parameter.name });
        this.scatter.show({
            series: [{ name: `${rows.length} samples`, unit: quantity.unit, points: true, scatter: true, x, y: rows.map((row) => row.results[this.quantity]),
                       keys: rows.map(({ sample }) => sample), names: rows.map(({ sample }) => sample), looks: rows.map((row) => this.look_of_quantity(row)),
                       notes: rows.map((row) => this.note(row)) }],
            x_label: parameter.kind === "factor" ? `${parameter.name} (factor)` : parameter.name, x_log: log, ...(is_choice ? { names: options.map((label, at) => ({ x: at, label: String(label) })) } : {}),
        });
    }

    note(row) {
        const result = this.results.get(row.sample);
        return [row.sample, ...Object.entries(row.values).map(([name, value]) => `${name} = ${typeof value === "number" ? number(value) : value}`),
                result?.flags?.length ? flag_note(result) : ""].filter(Boolean).join("\n");
    }

    draw_envelope() {
        const { envelopes } = this;
        const columns = Object.keys(envelopes?.bands ?? {});
        by_id("uncertainty-along").hidden = columns.length === 0;
        if (columns.length === 0) return;
        offer(by_id("uncertainty-column"), columns.map((value) => ({ value, text: along_x[value] ?? value.replaceAll("_", " ") })), columns[0]);
        const chosen = by_id("uncertainty-column").value;
        const { unit, p10, p50, p90, rests_on: count } = envelopes.bands[chosen];
        const most = envelopes.samples;
        // Fewer samples form another curve, which begins at the end of the first.
        const part = (name, is_in) => ({ name, unit, x: envelopes.x, y: p50.map((y, i) => (is_in(i) ? y : null)), low: p10, high: p90,
                                         names: count.map((each) => `${each} of ${most} samples came`) });
        const is_whole = (i) => count[i] === most;
        const fewer = part("p50, some never came", (i) => !is_whole(i) || (count[i + 1] ?? most) < most || (count[i - 1] ?? most) < most);
        this.envelope.labels.y = `${along_x[chosen] ?? chosen} [${unit || "–"}]`;
        this.envelope.show({ series: [part("p50", is_whole), ...(count.every((_, i) => is_whole(i)) ? [] : [fewer])], errors_name: "p10 to p90" });
        set_text(by_id("uncertainty-along-note"), `${most} of ${this.answer.samples.planned} samples. ` + (unit === "s"
            ? "A sample whose flow never came arrives after all others: a percentile ends where too few came." : "Where the flow of a sample never came it is 0 there.") +
            (this.answer.samples.moving ? ` ${this.answer.samples.moving} still moved when stopped: beyond their front depths and velocities are lower bounds.` : ""));
    }

    draw_samples(quantity) {
        const { parameters, rows } = this.answer;
        const open = ({ sample, task }) => element("span", { class: "row" }, element("button", { type: "button", class: "link", disabled: !task, onclick: () => this.open(sample) }, sample));
        const trace = ({ sample, has_result: traceable }) => (traceable ? element("button", { type: "button", class: "link", onclick: () => this.ask(sample) }, "trace") : "");
        const state = (record) => {
            const badge = element("span");
            show_state(badge, record.state);
            return badge;
        };
        const value = (record) => (record.value === null ? "–" : `${record.look.includes("bound") ? "≥ " : ""}${number(record.value)}`);
        this.table ??= new DataTable(by_id("uncertainty-samples"));
        this.table.open(`samples_${this.run.name}`, [
            { name: "sample", title: "sample", cell: open }, { name: "state", title: "state", cell: state },
            { name: "value", csv: this.quantity + (quantity?.unit ? ` [${quantity.unit}]` : ""), title: quantity?.name ?? this.quantity, unit: quantity?.unit, number: true, cell: value },
            ...parameters.map(({ name, kind }) => ({ name: `values ${name}`, title: name, number: kind !== "choice",
                                              cell: kind === "choice" ? null : (record) => number(record[`values ${name}`]) })),
            { name: "trace", title: "origin", cell: trace },
        ], rows.map((row) => ({ sample: row.sample, task: row.task, state: row.state, value: row.results?.[this.quantity] ?? null, look: this.look_of_quantity(row), has_result: has_result(row),
                                ...Object.fromEntries(Object.entries(row.values).map(([name, each]) => [`values ${name}`, each])) })), false);
    }
}

/// The share of samples above a value is constant up to the next value.
function in_steps(exceedance) {
    const points = exceedance.flatMap((each, i) => (i === 0 ? [each] : [{ ...exceedance[i - 1], value: each.value }, each]));
    return { x: points.map(({ value }) => value), y: points.map(({ probability }) => probability), low: points.map(({ low }) => low), high: points.map(({ high }) => high) };
}

/// Fills a select and keeps its choice.
function offer(select, options, first) {
    const before = select.value;
    mirror(select, options, ({ value }) => value, ({ value }) => element("option", { value }), (option, { text, title }) => {
        set_text(option, text);
        option.title = title ?? "";
    });
    select.value = options.some(({ value }) => value === before) ? before : first;
}

/// The options of a choice have no order, so no rank correlation.
const weight_of = ({ rank_correlation: rank, first_order: explained }) => (Number.isFinite(rank) ? Math.abs(rank) : Math.sqrt(Math.max(explained ?? 0, 0)));

/// Importance: rank correlation, partial rank correlation, and share of the variance; pale if it does not exceed the noise.
function draw_importance({ importance, count, of }, bounds) {
    const told = importance.some(({ rank_correlation: rank, first_order: explained }) => Number.isFinite(rank) || Number.isFinite(explained));
    by_id("uncertainty-importance").hidden = !told;
    set_text(by_id("uncertainty-importance-note"), told ? `${count} of ${of} samples. Pale: the interval contains 0, so the parameter may have no effect.${bounds}`
        : `${count} samples do not tell which parameter decides.`);
    if (!told) return;
    const ordered = [...importance].sort((a, b) => weight_of(b) - weight_of(a));
    mirror(by_id("uncertainty-importance-rows"), ordered, ({ parameter }) => parameter, () => element("tr", {}, element("th", { scope: "row" }),
           ...Array.from({ length: 4 }, () => element("td", { class: "number" }))), (row, { parameter, rank_correlation: rank, low, high, partial_rank_correlation: partial,
        first_order: explained, first_order_low: least, first_order_high: most }) => {
        const ends = (a, b) => (Number.isFinite(a) ? `${number(a, 2)} to ${number(b, 2)}` : "–");
        [parameter, number(rank, 2), ends(low, high), number(partial, 2), number(explained, 2)].forEach((text, i) => set_text(row.children[i], text));
        row.lastElementChild.title = `90 % interval: ${ends(least, most)}`;
        row.classList.toggle("waiting", Number.isFinite(low) ? low <= 0 && high >= 0 : !(least > 0));
    });
}
