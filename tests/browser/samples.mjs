// An uncertainty study with its answers, as the service gives them, from a model that is known:
//     runout = 40 s^-1.2 (eta / 550)^-0.15 m, 1.1 times that for motion 2, and half a metre for the lattice
// with s the residual strength's factor and eta the viscosity [Pa s]. Soil that would run beyond `end_of_time` was still moving when it
// was stopped there. Printed as JSON for other tests:
//     node tests/browser/samples.mjs 64 > tests/unit/report/uncertainty.json
import { fileURLToPath } from "node:url";

const end_of_time = 85; // [m] where runs were cut off
const quantity_names = { runout_beyond_toe: ["the same of the soil beyond the toe; 0: there is none", "m"],
                         runout: ["99 % of the mobile soil lies within this distance of the toe; negative: upstream of it", "m"] };

/// The same numbers every time: a linear congruential generator (Numerical Recipes, "quick and dirty").
function numbers_from(seed) {
    let state = seed >>> 0;
    return () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return (state + 0.5) / 2 ** 32;
    };
}

const normal = (u, v) => Math.sqrt(-2 * Math.log(u)) * Math.cos(2 * Math.PI * v);

function draw(next, number) {
    let strength = 0;
    while (!(strength > 0.4 && strength < 2.5)) strength = Math.exp(0.29 * normal(next(), next()));
    return { "residual strength": strength, viscosity: 100 * 30 ** next(), motion: next() < 2 / 3 ? "option 1" : "option 2", lattice: 1 + (number % 5) };
}

function model({ "residual strength": strength, viscosity, motion, lattice }) {
    const runout = 40 * strength ** -1.2 * (viscosity / 550) ** -0.15 * (motion === "option 2" ? 1.1 : 1) + 0.25 * (lattice - 3);
    const reached = Math.min(runout, end_of_time);
    return { runout_beyond_toe: reached, runout: reached - 0.4, moves: runout > end_of_time };
}

const name_of = (number) => `s${String(number).padStart(4, "0")}`;

/// Of a study: the samples that nothing was transferred of.
const stood_in = (study) => Object.fromEntries((study.stood ?? []).map((name) => [name, "not_reached"]));

/// {names that ended otherwise: state}: every 30th broke down, the last two have not ended.
export const open_or_failed = (samples) => Object.fromEntries([
    ...Array.from({ length: samples }, (_, i) => i + 1).filter((number) => number % 30 === 5).map((number) => [name_of(number), "failed"]),
    [name_of(samples - 1), "running"], [name_of(samples), "ready"]]);

export function uncertain_study(base, samples) {
    const next = numbers_from(7);
    const variants = Array.from({ length: samples }, (_, i) => {
        const values = draw(next, i + 1);
        return { name: name_of(i + 1), made_by: "uncertainty", sample: { number: i + 1, values },
                 overrides: [`/materials/sand/viscosity=${values.viscosity}`] };
    });
    return { ...base, name: "uncertain", title: "A column, uncertain", transfer_times: [1], uncertainty: { samples, seed: 7, parameters: [] }, variants };
}

const quantile = (sorted, p) => {
    const at = (sorted.length - 1) * p;
    const below = Math.floor(at);
    return sorted[below] + (at - below) * ((sorted[below + 1] ?? sorted[below]) - sorted[below]);
};
const percentiles = [5, 10, 50, 90, 95];
const needed = { 5: 59, 10: 29, 50: 5, 90: 29, 95: 59 };
const ascending = (values) => [...values].sort((a, b) => a - b);

function resampled(values, next, statistic) {
    const seen = Array.from({ length: values.length > 200 ? 20 : 200 }, () => statistic(values.map(() => values[Math.floor(next() * values.length)])));
    const sorted = ascending(seen);
    return { low: quantile(sorted, 0.05), high: quantile(sorted, 0.95) };
}

function ranks(values) {
    const order = values.map((_, i) => i).sort((a, b) => values[a] - values[b]);
    const result = [];
    order.forEach((at, rank) => { result[at] = rank; });
    return result;
}

function correlation(a, b) {
    const mean = (list) => list.reduce((sum, each) => sum + each, 0) / list.length;
    const [of_a, of_b] = [mean(a), mean(b)];
    const sum = (f) => a.reduce((total, _, i) => total + f(a[i] - of_a, b[i] - of_b), 0);
    return sum((x, y) => x * y) / Math.sqrt(sum((x) => x * x) * sum((_, y) => y * y));
}

const level = (value) => (typeof value === "number" ? value : Number(/\d+$/.exec(value)[0]));

function quantity(rows, name, next, parameters) {
    const done = rows.filter((row) => row.results[name] !== null);
    const values = done.map((row) => row.results[name]);
    const [label, unit] = quantity_names[name];
    const sorted = ascending(values);
    const mean = values.reduce((sum, each) => sum + each, 0) / values.length;
    const importance = parameters.map((parameter) => {
        const x = done.map((row) => level(row.values[parameter]));
        const pairs = x.map((each, i) => [each, values[i]]);
        const rank = (list) => correlation(ranks(list.map(([a]) => a)), ranks(list.map(([, b]) => b)));
        const own = rank(pairs);
        const share = { first_order: own ** 2, first_order_low: 0.8 * own ** 2, first_order_high: Math.min(1, 1.2 * own ** 2) };
        return ["motion", "lattice"].includes(parameter) // no order
            ? { parameter, measure: "correlation_ratio", rank_correlation: null, low: null, high: null, partial_rank_correlation: null, ...share }
            : { parameter, measure: "rank_correlation", rank_correlation: own, ...resampled(pairs, next, rank), partial_rank_correlation: own, ...share };
    });
    const told = percentiles.filter((p) => values.length >= needed[p]);
    const middle = { "residual strength": 1, viscosity: 550, motion: "option 1", lattice: 3 };
    const at = (change) => model({ ...middle, ...change })[name];
    const bars = [["residual strength", 0.69, 1.45], ["viscosity", 140, 2130], ["motion", "option 1", "option 2"]]
        .map(([parameter, low, high]) => ({ parameter, p10: at({ [parameter]: low }), p90: at({ [parameter]: high }) }));
    const bounds = rows.filter((row) => row.moves && Number.isFinite(row.results[name])).map((row) => row.results[name]);
    return { label, unit, grows: true, count: values.length, of: rows.length, mean, bound_from: bounds.length ? Math.min(...bounds) : null, sd: Math.sqrt(values.reduce((sum, v) => sum + (v - mean) ** 2, 0) / (values.length - 1)),
             percentiles: values.length < needed[50] ? { refused: `${values.length} samples are not enough for the 50th percentile: ${needed[50]} are needed` }
                 : told.map((p) => ({ p, value: quantile(sorted, p / 100), ...resampled(values, next, (list) => quantile(ascending(list), p / 100)) })),
             percentiles_lacking: percentiles.filter((p) => !told.includes(p)).map((p) => ({ p, needs: needed[p] })),
             exceedance: sorted.filter((_, i) => sorted.length <= 101 || i % Math.ceil(sorted.length / 101) === 0 || i === sorted.length - 1).map((value) => {
                 const probability = sorted.filter((each) => each > value).length / sorted.length;
                 const half = 1.64 * Math.sqrt((probability * (1 - probability) + 0.25 / sorted.length) / sorted.length);
                 return { value, probability, low: Math.max(0, probability - half), high: Math.min(1, probability + half) };
             }),
             importance,
             tornado: name === "runout" || values.length < 10 ? { refused: "Q2 is 0.4; 0.7 is needed", q2: 0.4 }
                 : { q2: 0.93, at_median: at({}), bars } };
}

/// task_of(sample's name): of its runout.
export function uncertainty_of({ id, name, study, state = "succeeded" }, task_of) {
    const odd = { ...open_or_failed(study.variants.length), ...stood_in(study) };
    const next = numbers_from(11);
    const rows = study.variants.map(({ name: sample, sample: { values } }) => {
        const { moves, ...results } = model(values);
        const own = odd[sample] ?? (moves ? "questionable" : "succeeded");
        return { sample, task: task_of(sample), state: own, values, moves: moves && !odd[sample], results: odd[sample] ? { runout_beyond_toe: null, runout: null } : results };
    });
    const done = rows.filter((row) => row.results.runout !== null).length;
    const failed = rows.filter((row) => row.state === "failed");
    const stood = rows.filter((row) => row.state === "not_reached");
    const parameters = [
        { name: "residual strength", kind: "factor", distribution: { type: "lognormal", median: 1, cov: 0.3 }, between: [0.4, 2.5],
          entries: ["/materials/sand/law/softening/c_residual_kPa"], asked_correlation: { viscosity: 0.3 } },
        { name: "viscosity", kind: "value", distribution: { type: "log_uniform", from: 100, to: 3000 }, between: null, entries: ["/materials/sand/viscosity"], asked_correlation: {} },
        { name: "motion", kind: "choice", distribution: null, between: null, entries: [], asked_correlation: {} },
        { name: "lattice", kind: "numerical", distribution: null, between: null, entries: [], asked_correlation: {} },
    ];
    return { run: id, name, state, quantity: "runout_beyond_toe", sampling: "latin_hypercube", seed: 7, confidence: 0.9,
             samples: { planned: rows.length, done, failed: failed.length, questionable: rows.filter((row) => row.state === "questionable").length, open: rows.length - done - failed.length - stood.length,
                        no_transfer: stood.length, moving: rows.filter((row) => row.moves).length, doubtful: 0,
                        left_out: [...failed.map(({ sample }) => ({ sample, state: "failed", reason: "exit 70: a point left the grid at 3.2 s" })),
                                   ...stood.map(({ sample }) => ({ sample, state: "not_reached", reason: "window: the FEM ended at 25 s" }))] },
             parameters, rows,
             quantities: Object.fromEntries(Object.keys(quantity_names).map((each) => [each, quantity(rows, each, next, parameters.map((one) => one.name))])),
             cautions: [failed.length && `${failed.length} samples of ${rows.length} left no result and are in no number here.`,
                        stood.length && `No transfer from ${stood.length} samples of ${rows.length}: the FEM ended and no trigger fired.`].filter(Boolean),
             until: { quantity: "runout_beyond_toe", percentile: 90, half_width: 0.1, reached: false, now: 0.13 }, inverse: null,
             sentences: [`${done} of ${rows.length} samples ended; ${failed.length} failed and are in no percentile.`] };
}

/// Depth, velocity and arrival along x: each sample a wedge as long as its runout; who never came is 0 there and arrives after all others.
export function envelopes_of({ study }) {
    const odd = open_or_failed(study.variants.length);
    const lengths = study.variants.filter(({ name }) => !odd[name]).map(({ sample }) => model(sample.values).runout_beyond_toe);
    const x = Array.from({ length: 101 }, (_, i) => i - 5);
    const finite = (value) => (Number.isFinite(value) ? value : null);
    const along = (unit, value, absent) => {
        const columns = x.map((at) => ascending(lengths.map((length) => (at < length ? value(at, length) : absent))));
        const of = (p) => columns.map((column) => finite(quantile(column, p)));
        return { unit, p10: of(0.1), p50: of(0.5), p90: of(0.9), rests_on: columns.map((column) => column.filter(Number.isFinite).length) };
    };
    return { x, samples: lengths.length, of: study.variants.length, reached: x.map((at) => lengths.filter((length) => at < length).length),
             bands: { largest_depth: along("m", (at, length) => (6 * (1 - Math.max(at, 0) / length)) ** 0.7, 0),
                      largest_velocity: along("m/s", (at, length) => 0.9 * Math.sqrt(length - at), 0),
                      arrival: along("s", (at, length) => Math.max(at, 0) / (0.9 * Math.sqrt(length)), Infinity) } };
}

/// The model's results of a sample, as a row of the run's results has them.
export const results_of_sample = (values) => model(values);

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const study = uncertain_study({}, Number(process.argv[2] ?? 64));
    const run = { id: "01", name: "uncertain", study };
    console.log(JSON.stringify({ uncertainty: uncertainty_of(run, (sample) => `mpm_${sample}`), envelopes: envelopes_of(run) }, (_, each) =>
        (typeof each === "number" ? Number(each.toPrecision(6)) : each), 1));
}
