// A stand-in for the orchestrator: the same REST shapes over real HTTP, with made-up runs that advance by the clock.
// Only for tests of the page; the soil here is a formula, not mechanics.
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";
import path from "node:path";
import { envelopes_of, open_or_failed, results_of_sample, uncertainty_of } from "./samples.mjs";

const static_folder = fileURLToPath(new URL("../../services/web/static", import.meta.url));
const schema_folder = fileURLToPath(new URL("../../workflows/schema", import.meta.url));
const content_types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };

const scene = {
    format: "breachline-scene/1", name: "column",
    section: { regions: [{ name: "base", material: "rock", polygon: [[0, 0], [10, 0], [10, 5], [0, 5], [0, 0]] },
                         { name: "column", material: "sand", polygon: [[0, 0], [10, 0], [10, 20], [0, 20], [0, 0]] }] },
    fem: { water: { line: [[0, 14], [10, 12]] } },
    mpm: { runout: { toe: [10, 0] }, floor: { level: 0 }, gauges: [{ name: "road", x: 14 }, { name: "house", x: 18 }] },
};
export const study = { format: "breachline-study/1", name: "fake-column", title: "A column made of formulas", scene,
                       transfer_times: [0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2] };
/// The same soil twice: softened, and not; with triggers that have fired.
export const two_variants = {
    ...study, name: "softened-or-not", title: "Softened, and not softened",
    variants: [{ name: "softened", overrides: ["/materials/sand/softening=1"] }, { name: "not-softened", overrides: [] }],
    triggers: [{ kind: "criterion", name: "strained", when: "epsilon_q_avg > 0.05 and time > 0.1", hold_s: 0.05 },
               { kind: "window", name: "window", lower: "crest_dx > 0.2", upper: "0.9 > jacobian_ratio_avg", pick: "midpoint" },
               { kind: "bisect", name: "edges", share: 0.75, tolerance_s: 0.05 }],
};

export const drawn = {
    ...study, name: "three-draws", title: "Three draws of every runout", draws: 3,
    variants: ["d1", "d2", "d3"].map((name) => ({ name, overrides: [], made_by: "draws" })),
};

const flag = (code, severity, message, pointer = "") => ({ code, severity, message, pointer });
export const still_moving = flag("still_moving", "questionable", "12 % of the released energy is left at 6 s: the runout is a lower bound; " +
                                 "let it run on", "/mpm/duration");
export const numerical_share = flag("numerical_share", "questionable", "the scheme took 31 % of the released energy, 20 % is the limit");
export const implausible = flag("implausible", "warning", "19 looks like kN/m3: 1,937 kg/m3", "/materials/sand/density");
const entangled_at = (time) => flag("entangled", "warning", `the mesh entangled at ${time} s in element 212, in the failure's band`);
/// What the runouts of a run with flags carry, by transfer time; all others are sound.
export const some_flagged = { 0.5: [still_moving], 0.75: [numerical_share], 1: [still_moving, numerical_share], 1.5: [implausible] };

/// Twelve strengths at one transfer time.
const strengths = Array.from({ length: 12 }, (_, i) => `strength_x_${(0.7 + 0.05 * i).toFixed(2)}`);
export const twelve_variants = { ...study, name: "twelve", title: "Twelve strengths at one transfer time", transfer_times: [1],
    variants: strengths.map((name, i) => ({ name, overrides: [`/materials/sand/law/c_kPa=${10 + i}`] })) };
export const twelve_curves = { ...twelve_variants, name: "twelve-curves", title: "Twelve strengths, eight times", transfer_times: study.transfer_times };

const digest = (text) => createHash("sha256").update(text).digest("hex");
const clamp = (value) => Math.min(1, Math.max(0, value));

/// A circle through the column, and how far the soil came to the gauges.
const stability = { factor_of_safety: 0.912, surface: "circle", circle: { center: [20, 22], radius: 18.9 }, entry: [1.3, 20], exit: [10, 6], flags: [] };
const gauges_of = (runout) => Object.fromEntries(scene.mpm.gauges.map(({ name, x }) => [name, {
    x, arrival_time: x < 10 + runout ? (x - 10) / 2 : null, largest_depth: x < 10 + runout ? 1.5 : 0, largest_velocity: x < 10 + runout ? 4 : 0 }]));
/// A wedge that is as long as the runout.
const profile_of = (runout) => ["x_m,ground_m,depth_m,surface_m,velocity_m_per_s", ...Array.from({ length: 40 }, (_, x) => {
    const depth = Math.max(0, 12 * (1 - x / (10 + runout)));
    return `${x},0,${depth},${depth},0`;
})].join("\n");

/// One run: FEM for a while, each transfer soon after its time, then two MPM runs side by side.
class FakeRun {
    /// pace: seconds that the whole run takes; points: particles per snapshot; flagged: as some_flagged; entangles: [s];
    /// breaks: transfer times whose transfer fails.
    constructor(id, submitted, { pace, points, began = Date.now(), flagged = {}, entangles = null, breaks = [1.25] }) {
        Object.assign(this, { id, study: submitted, pace, points, began, cancelled_at: null, flagged, entangles });
        const times = submitted.transfer_times;
        const [fem_end, mpm_time] = [0.4 * pace, (0.6 * pace * 2) / times.length];
        this.tasks = [{ phase: "lem_tool", from: 0, to: 0.1 * pace }, { phase: "fem_solver", from: 0, to: fem_end }];
        const variants = (submitted.variants ?? [{ name: "" }]).map(({ name }) => name);
        times.forEach((transfer_time, i) => {
            const taken = ((i + 1) / times.length) * fem_end;
            const begin = Math.max(taken, fem_end + Math.floor(i / 2) * mpm_time);
            const broken = breaks.includes(transfer_time);
            const not_reached = entangles !== null && transfer_time > entangles;
            this.tasks.push({ phase: "transfer_tool", transfer_time, from: taken, to: taken + 0.02 * pace, fails: broken,
                              skipped: not_reached, not_reached });
            const odd = submitted.uncertainty ? open_or_failed(variants.length) : {};
            for (const variant of variants) {
                if (odd[variant] === "failed") {
                    this.tasks.push({ phase: "mpm_solver", transfer_time, variant, from: begin, to: begin + mpm_time, fails: true });
                    continue;
                }
                if (odd[variant]) {
                    this.tasks.push({ phase: "mpm_solver", transfer_time, variant, from: 1e9, to: 2e9 });
                    continue;
                }
                this.tasks.push({ phase: "mpm_solver", transfer_time, variant, from: begin, to: begin + mpm_time, skipped: broken || not_reached, not_reached });
            }
        });
        this.tasks.forEach((task, i) => Object.assign(task, { id: `${id}-task-${i}`, variant: task.variant ?? "" }));
    }

    age() {
        return ((this.cancelled_at ?? Date.now()) - this.began) / 1000;
    }

    progress_of(task) {
        return clamp((this.age() - task.from) / (task.to - task.from));
    }

    state_of(task) {
        const progress = this.progress_of(task);
        if (task.skipped && this.age() > task.from) return "skipped";
        if (progress >= 1) return task.fails ? "failed" : "succeeded";
        if (this.cancelled_at) return "cancelled";
        return progress > 0 ? "running" : "blocked";
    }

    describe_task(task) {
        const state = this.state_of(task);
        const at = (age) => new Date(this.began + 1000 * age).toISOString();
        const started = !["blocked", "skipped"].includes(state) && this.age() > task.from;
        const ended = !["blocked", "running"].includes(state);
        return {
            id: task.id, run: this.id, phase: task.phase, label: `${task.phase}_${task.transfer_time ?? ""}${task.variant}`,
            transfer_time: task.transfer_time ?? null, variant: task.variant, same_as: null, not_reached: Boolean(task.not_reached),
            state, progress: this.progress_of(task), message: state === "running" ? "step 120, dt 1.2 ms" : "",
            result: state !== "succeeded" ? null : task.phase === "mpm_solver" ? { ...this.runout(task), gauges: gauges_of(this.runout(task).runout) } : task.phase === "lem_tool" ? stability : null,
            fault: state === "failed" ? { exit_code: 70, summary: "mass differs by 3e-9, 1e-12 is allowed" } : null,
            attempts: started ? [{ number: 1, state: ended ? "exited" : "running", started: at(task.from),
                                   finished: ended ? at(task.to) : null, exit_code: ended ? (task.fails ? 70 : 0) : null, signal: null,
                                   wall_seconds: ended ? task.to - task.from : null, cpu_seconds: ended ? 1.5 : null }] : [],
            ...this.verdict_of(task, state === "succeeded"),
            artifacts: state !== "succeeded" ? [] : ["result.json", "scene.completed.json", "telemetry.jsonl", ...(task.phase === "mpm_solver" ? ["profile.csv"] : [])]
                .map((name) => ({ name, sha256: digest(task.id + name), bytes: 2345 })),
        };
    }

    /// What the model of an uncertainty study says of a variant; null of any other.
    sample_of(variant) {
        if (!this.study.uncertainty) return null;
        this.samples ??= new Map(this.study.variants.map(({ name, sample }) => [name, results_of_sample(sample.values)]));
        return this.samples.get(variant) ?? null;
    }

    uncertainty() {
        return uncertainty_of(this, (sample) => this.tasks.find((task) => task.phase === "mpm_solver" && task.variant === sample).id);
    }

    /// Its own flags, and how it ended.
    verdict_of({ phase, transfer_time, variant }, ended_well) {
        if (!ended_well) return { ended: null, end_time: null, questionable: null, flags: null };
        if (phase === "fem_solver") {
            const flags = this.entangles ? [entangled_at(this.entangles)] : [];
            return { ended: flags.length ? "entangled" : "complete", end_time: this.entangles ?? 2, questionable: false, flags };
        }
        if (phase !== "mpm_solver") return { ended: null, end_time: null, questionable: false, flags: [] };
        const key = variant === "not-softened" ? "none" : transfer_time;
        const flags = this.sample_of(variant)?.moves ? [still_moving] : key in this.flagged ? this.flagged[key] : [];
        const moving = flags?.includes(still_moving);
        return { ended: flags && (moving ? "duration" : "at_rest"), end_time: flags && 6, flags,
                 questionable: flags && flags.some(({ severity }) => severity === "questionable") };
    }

    runout({ transfer_time, variant = "" }) {
        const sample = this.sample_of(variant);
        if (sample) return { runout: sample.runout_beyond_toe - 0.4, runout_beyond_toe: sample.runout_beyond_toe, runout_largest: sample.runout_beyond_toe + 2,
                             volume_ratio: 1.01, numerical_share: 0.03, overlap: 0.004, cpu_seconds: 7.25 };
        const strength = Number(variant.match(/^strength_x_(.*)/)?.[1] ?? 1);
        const draw = Number(variant.match(/^d(\d)$/)?.[1] ?? 1);
        const reach = (draw - 1) * 0.5 + (variant === "not-softened" ? 0.4 : 1) * (11 / strength) + 6 * Math.exp(-((transfer_time - 1) ** 2)) - 1.5 * transfer_time;
        return { runout: reach, runout_beyond_toe: reach + 1.2, runout_largest: reach + 2.5, depth_beyond_toe: Math.max(0, 12 * (1 - 11 / (10 + reach))),
                 volume_ratio: 1.01, numerical_share: 0.031 + 0.01 * transfer_time, overlap: 0.004, cpu_seconds: 7.25 + transfer_time };
    }

    /// What the page traces a number with.
    result_file(task) {
        const sources = { mpm_solver: "transfer_tool", transfer_tool: "fem_solver" };
        const source = this.tasks.find((other) => other.phase === sources[task.phase] && [undefined, task.transfer_time].includes(other.transfer_time));
        const overrides = (this.study.variants ?? []).find(({ name }) => name === task.variant)?.overrides ?? [];
        return { ...this.runout(task), provenance: { phase: task.phase, version: "0.1.0", threads: 1, overrides, cpu_seconds: 1.5,
            inputs: source ? [{ path: `/data/${source.id}/particles.vtkhdf`, sha256: digest(`${source.id}particles`) }] : [] } };
    }

    triggers() {
        const fem = this.tasks.find((task) => task.phase === "fem_solver");
        const over = this.progress_of(fem) >= 1;
        const firing = (time, crossed) => ({ transfer_time: time, wanted_time: time, lag_s: 0, snapshot: `snapshot_${time}.vtkhdf`,
            sha256: digest(`snapshot${time}`), crossed, fem_step: 200 * time, snapshot_ms: 4, fired_ms: 9, start_ms: 40 });
        const fired = { strained: [firing(0.75, { epsilon_q_avg: 0.0512, step: 140, time: 0.7 })],
                        window: [firing(1, { lower: { crest_dx: 0.21, step: 160, time: 0.8 }, upper: { jacobian_ratio_avg: 0.899, step: 240, time: 1.2 } })],
                        edges: [firing(0.5, null), firing(1.75, null)] };
        return (this.study.triggers ?? []).map((spec, i) => ({ id: `${this.id}-t${i}`, name: spec.name, kind: spec.kind, fem_task: fem.id, spec,
            state: over ? "fired" : "armed", reason: "", firings: over ? fired[spec.name] : [],
            result: over && spec.kind === "bisect" ? { complete: true, runs: 5, uniform_runs: 40, largest_runout: 15.5, largest_at: 1,
                lower: { off: 0.25, on: 0.5 }, upper: { off: 2, on: 1.5 } } : null }));
    }

    transfers() {
        const fem = this.tasks.find((task) => task.phase === "fem_solver");
        return this.tasks.filter(({ phase }) => phase === "transfer_tool").map(({ id }) => ({ task: id, fem_task: fem.id }));
    }

    summary() {
        const states = this.tasks.map((task) => this.state_of(task));
        const count = (...wanted) => states.filter((state) => wanted.includes(state)).length;
        const over = count("blocked", "running") === 0;
        const verdicts = this.tasks.map((task, i) => this.verdict_of(task, states[i] === "succeeded"));
        const questionable = verdicts.filter((each) => each.questionable).length;
        const flag_counts = {};
        for (const { code } of verdicts.flatMap(({ flags }) => flags ?? [])) flag_counts[code] = (flag_counts[code] ?? 0) + 1;
        const state = !over ? "running" : this.cancelled_at ? "cancelled" : count("failed") ? "partial" : questionable ? "questionable" : "succeeded";
        const moving = flag_counts.still_moving ?? 0;
        return { governing: this.governing(over), stability: this.stability(), headline: this.headline(over), warnings: this.study.warnings ?? [], id: this.id, name: this.study.name, title: this.title ?? this.study.title, state,
                 created: new Date(this.began).toISOString(), started: new Date(this.began).toISOString(),
                 finished: over ? new Date(Math.min(Date.now(), this.began + 1000 * this.pace)).toISOString() : null,
                 progress: clamp(this.age() / this.pace), tasks_total: states.length, tasks_done: count("succeeded"),
                 tasks_failed: count("failed"), questionable, flag_counts, paused: Boolean(this.paused),
                 verdict: this.run_verdict(questionable, flag_counts, verdicts.flatMap(({ flags }) => flags ?? [])), message: moving ? `${moving} of ${this.rows().length} runouts still moving: lower bounds` : "",
                 seconds_left: over || this.paused ? null : this.pace - this.age() };
    }

    /// As services/findings judges it, with what the fake knows.
    run_verdict(questionable, flag_counts, flags) {
        const usable_of = ({ code, severity }) => (code === "implausible" ? "no" : severity === "questionable" ? "questionable" : "with_remarks");
        const name_of = (code) => code[0].toUpperCase() + code.slice(1).replaceAll("_", " ");
        const order = ["no", "questionable", "with_remarks"];
        const reasons = [...(this.study.warnings ?? []).map(({ code, message, pointer }) => ({ usable: "with_remarks", code, brief: "",
                             text: `${name_of(code)}, at submission (${pointer}): ${message}.`, pointer })),
                         ...(this.study.without ?? []).map(({ variant, reason }) => ({ usable: "with_remarks", code: "no_transfer", brief: "",
                             text: `No transfer${variant ? ` from ${variant}` : ""}, so there is no runout: ${reason}. The dam may stand; then nothing runs out.`, pointer: "" })),
                         ...(this.study.same ?? []).map((names) => ({ usable: "with_remarks", code: "same_results", brief: "",
                             text: `The variants ${names.join(", ")} have identical results: the entries that differ had no effect.`, pointer: "" })),
                         ...Object.keys(flag_counts).map((code) => flags.find((each) => each.code === code)).map((each) => ({
                             usable: usable_of(each), code: each.code, brief: `${flag_counts[each.code]} of ${this.rows().length} runouts ${each.code === "still_moving" ? "still moving: lower bounds" : `flagged ${each.code}`}`,
                             text: `${name_of(each.code)}, ${flag_counts[each.code]} of ${this.rows().length} runouts: ${each.message}.`, pointer: each.pointer, count: flag_counts[each.code] }))].map((reason) => ({ count: 1, ...reason }))
            .sort((a, b) => order.indexOf(a.usable) - order.indexOf(b.usable));
        const usable = flag_counts.implausible ? "no" : questionable ? "questionable" : reasons.length ? "with_remarks" : "yes";
        return { usable, words: { no: "not usable", with_remarks: "usable, with remarks", yes: "usable" }[usable] ?? usable, reasons };
    }

    /// As services/findings words it, with what the fake knows.
    headline(over) {
        const [soil, factor] = [this.governing(over)?.runout, this.stability()?.factor_of_safety];
        const text = [soil > 0 ? `flows ${soil.toFixed(1)} m beyond the toe` : "", factor ? `FS ${factor} as built` : ""].filter(Boolean).join("; ");
        return { outcome: soil > 0 ? "flows" : "not_known", text };
    }

    stability() {
        const lem = this.tasks.find(({ phase }) => phase === "lem_tool");
        return this.progress_of(lem) < 1 ? null : { task: lem.id, variant: "", factor_of_safety: stability.factor_of_safety, factor_of_safety_liquefied: null };
    }

    /// What the service would choose: the largest runout.
    governing(over) {
        if (this.chosen) return this.chosen;
        const farthest = this.rows().filter((row) => Number.isFinite(row.runout)).sort((a, b) => b.runout - a.runout)[0];
        if (!farthest) return null;
        const { variant, transfer_time, mpm_task: task, runout, lower_bound, depth_beyond_toe } = farthest;
        const chosen = { task, variant, transfer_time, runout, lower_bound, depth_beyond_toe };
        if (over) this.chosen = chosen;
        return chosen;
    }

    rows() {
        const trigger_of = (time) => this.triggers().find(({ firings }) => firings.some((firing) => firing.transfer_time === time));
        return this.tasks.filter((task) => task.phase === "mpm_solver").map((mpm) => {
            const { transfer_time, variant } = mpm;
            const transfer = this.tasks.find((task) => task.phase === "transfer_tool" && task.transfer_time === transfer_time);
            const failed = this.state_of(transfer) === "failed";
            const own = failed ? "failed" : this.state_of(mpm);
            const numbers = own === "succeeded" ? this.runout(mpm) : {};
            const { ended, end_time, questionable, flags } = this.verdict_of(mpm, own === "succeeded");
            const state = questionable ? "questionable" : own === "skipped" && mpm.not_reached ? "not_reached" : own;
            const moving = ended && ended === "duration";
            return { transfer_time, variant, state, transfer_task: transfer.id, mpm_task: mpm.id, reused: false,
                     ended, end_time, questionable, flags: flags?.map((each) => ({ ...each, phase: "mpm_solver" })) ?? null,
                     runout_error: this.study.draws && own === "succeeded" ? 0.1 * this.study.draws : null,
                     runout_error_from: this.study.draws ? `scatter of ${this.study.draws} draws` : "",
                     at_rest: ended && !moving, lower_bound: ended && moving, kinetic_share: ended && (moving ? 0.12 : 0.001),
                     factor_of_safety: own === "succeeded" ? stability.factor_of_safety : null,
                     trigger: trigger_of(transfer_time)?.name ?? "at_time", reason: failed ? "mass differs by 3e-9, 1e-12 is allowed"
                         : mpm.not_reached ? `its FEM ended regularly at ${this.entangles} s, before this time` : "",
                     ...Object.fromEntries(Object.keys(this.runout(mpm)).map((key) => [key, numbers[key] ?? null])) };
        });
    }

    /// Of a study whose variants are its draws.
    means() {
        if (!(this.study.variants ?? []).some(({ made_by }) => made_by === "draws")) return [];
        const rows = this.rows();
        return [...new Set(rows.map((row) => row.transfer_time))].map((transfer_time) => {
            const draws = rows.filter((row) => row.transfer_time === transfer_time);
            const done = draws.filter((row) => Number.isFinite(row.runout));
            const missing = draws.filter((row) => !Number.isFinite(row.runout)).map(({ variant, state }) => `${variant}: ${state}`);
            const mean = { transfer_time, variant: "", draws: draws.length, draws_done: done.length, missing_draws: missing.join("; "),
                           questionable_draws: done.filter((row) => row.questionable).map((row) => row.variant).join("; "),
                           state: done.length === draws.length ? "succeeded" : done.length ? "partial" : draws[0].state,
                           runout_error: done.length ? 0.8 : null, runout_error_from: "scatter of the mean of 3 repeats" };
            for (const key of Object.keys(this.runout({ transfer_time }))) {
                const values = done.map((row) => row[key]);
                const average = values.reduce((sum, each) => sum + each, 0) / values.length;
                mean[key] = values.length ? average : null;
                mean[`${key}_deviation`] = values.length < 2 ? null
                    : Math.sqrt(values.reduce((sum, each) => sum + (each - average) ** 2, 0) / (values.length - 1));
            }
            return mean;
        });
    }

    telemetry(phase) {
        const task = this.tasks.find((candidate) => candidate.phase === phase);
        const lines = [];
        const count = Math.floor(401 * this.progress_of(task));
        for (let i = 0; i < count; i += 1) {
            const time = i * 0.005;
            const slip = Math.max(0, time - 0.3);
            const on_way = Math.max(0, 6 * time - 3); // the runout's 12 s
            const gauges = { "gauge.road.depth": 2 * (1 - Math.exp(-on_way)), "gauge.road.velocity": 5 * on_way * Math.exp(-on_way),
                             "gauge.house.depth": 0, "gauge.house.velocity": 0 };
            lines.push({ ...(phase === "mpm_solver" ? { time: 6 * time, ...gauges } : { time }), crest_dx: 0.8 * slip ** 2, crest_dy: -1.1 * slip ** 2,
                         kinetic_energy: 4e5 * slip ** 2 * Math.exp(-slip), jacobian_ratio_avg: 1 - 0.12 * slip,
                         epsilon_q_avg: 0.03 + 0.2 * slip ** 1.5, newton_iterations: 3 + (i % 4), liquefaction_depth: 8 * Math.min(1, slip),
                         critical_depth: 6, r_u_max: Math.min(1, slip), failure_surfaces: Math.floor(2 * slip),
                         external_work: 5e5 * slip ** 2, internal_work: 1e5 * slip ** 2 });
        }
        return lines;
    }

    frames(task) {
        const count = Math.floor(24 * this.progress_of(task)) + (this.progress_of(task) > 0 ? 1 : 0);
        const kind = task.phase === "fem_solver" ? "mesh" : "particles";
        return Array.from({ length: count }, (_, i) => ({ time: i * 0.5, name: `snapshot_${String(i).padStart(5, "0")}`,
                                                          sha256: digest(`${task.id}${i}`), kind }));
    }

    /// The bytes of one snapshot: a column that spreads out.
    points_of(task, index, stride) {
        const is_mesh = task.phase === "fem_solver";
        const rows = is_mesh ? 41 : Math.round(Math.sqrt(2 * this.points));
        const columns = is_mesh ? 21 : Math.round(this.points / rows);
        const spread = 1 - Math.exp(-index / (is_mesh ? 30 : 6));
        const values = { x: [], y: [], speed: [], epsilon_q: [], region: [], r_u: [], pore_pressure: [],
                         ...(is_mesh ? { u_x: [], u_y: [], displacement: [], sigma_v: [] } : { epsilon_q_plastic: [] }) };
        for (let j = 0; j < rows; j += 1) {
            for (let i = 0; i < columns; i += 1) {
                if (!is_mesh && (j * columns + i) % stride !== 0) continue;
                const [u, v] = is_mesh ? [i / (columns - 1), j / (rows - 1)] : [(i + 0.5) / columns, (j + 0.5) / rows];
                const reach = 10 * (1 + 1.6 * spread * (1 - v) ** 1.5 * u);
                values.x.push(u * reach);
                values.y.push(20 * v * (1 - 0.6 * spread * (0.4 + 0.6 * u)));
                values.speed.push(6 * spread * (1 - spread) * 4 * u * (1 - v));
                values.epsilon_q.push(1.4 * spread * Math.exp(-(((v - 0.9 * (1 - u)) / 0.25) ** 2)));
                values.region.push(v < 0.25 ? 0 : 1);
                values.r_u.push(is_mesh && v > 0.7 ? NaN : spread * (1 - v)); // dry above
                values.pore_pressure.push(2e5 * (0.7 - v)); // suction above the water
                if (!is_mesh) {
                    values.epsilon_q_plastic.push(values.epsilon_q.at(-1) / 2);
                    continue;
                }
                values.u_x.push(values.x.at(-1) - 10 * u);
                values.u_y.push(values.y.at(-1) - 20 * v);
                values.displacement.push(Math.hypot(values.u_x.at(-1), values.u_y.at(-1)));
                values.sigma_v.push(3e5 * (1 - v));
            }
        }
        const quads = [];
        for (let j = 0; is_mesh && j < rows - 1; j += 1) {
            for (let i = 0; i < columns - 1; i += 1) {
                const n = j * columns + i;
                quads.push(n, n + 1, n + columns + 1, n + columns);
            }
        }
        const header = { time: index * 0.5, count: values.x.length, fields: Object.keys(values), regions: ["base", "column"],
                         ...(is_mesh ? { quads: quads.length / 4 } : {}) };
        let line = JSON.stringify(header);
        line += " ".repeat((4 - ((line.length + 1) % 4)) % 4) + "\n";
        return Buffer.concat([Buffer.from(line), ...Object.values(values).map((list) => Buffer.from(Float32Array.from(list).buffer)),
                              Buffer.from(Uint32Array.from(quads).buffer)]);
    }
}

export class FakeApi {
    /// pace: seconds per submitted run; points: particles per snapshot.
    constructor({ pace = 6, points = 5000 } = {}) {
        Object.assign(this, { pace, points, runs: [], events: [], requests: [], files: [], most_per_page: 500, workers: null });
    }

    add_run(submitted, settings = {}) {
        const run = new FakeRun(`run-${this.runs.length + 1}`, submitted, { pace: this.pace, points: this.points, ...settings });
        this.runs.push(run);
        this.tell(run.id, "created");
        return run;
    }

    tell(run, kind) {
        this.events.push({ seq: this.events.length + 1, time: new Date().toISOString(), run, task: null, kind, detail: {} });
    }

    async open(port = 0) {
        this.server = createServer((request, response) => this.answer(request, response).catch((fault) => {
            console.error(fault);
            problem(response, 500, String(fault));
        }));
        await new Promise((resume) => this.server.listen(port, "127.0.0.1", resume));
        return `http://127.0.0.1:${this.server.address().port}`;
    }

    async close() {
        this.server.closeAllConnections();
        await new Promise((resume) => this.server.close(resume));
    }

    async answer(request, response) {
        const url = new URL(request.url, "http://localhost");
        this.requests.push(`${request.method} ${url.pathname}`);
        const parts = url.pathname.split("/").filter(Boolean);
        if (parts[0] !== "v1") return this.serve_file(response, url.pathname);
        const [, kind, id, ...rest] = parts;
        if (kind === "artifacts") return this.serve_artifact(id, response);
        if (kind === "storage") {
            return json(response, { runs: this.runs.map((run) => ({ id: run.id, freed_bytes: 12.3e6, shared_bytes: 4e6 })) });
        }
        if (kind === "events") return this.serve_events(url, response);
        if (kind === "workers") return json(response, this.workers);
        if (kind === "examples") {
            return json(response, id ? study : { examples: [{ name: study.name, title: study.title }] });
        }
        if (kind === "schema") return json(response, JSON.parse(await readFile(path.join(schema_folder, `${id}.schema.json`))));
        if (kind === "files") return this.answer_files(request, url, response);
        if (kind === "cost") return json(response, { lines: ["All, 8 mpm_solver: 2 CPU min (1.2 to 3.4), 120 MB"] });
        if (kind === "draw") return this.draw(request, response);
        if (kind === "scenes") return json(response, { plans: { fem_solver: "on        softening  the law of sand has it  (/materials/sand)\nleft out  gmsh       regions are blocks  (/section)\n" } });
        if (kind === "tasks") return this.serve_task(id, rest, url, response);
        if (kind === "runs" && !id) {
            if (request.method === "POST") return this.submit(request, response);
            return this.list_runs(url, response);
        }
        const run = this.runs.find((candidate) => candidate.id === id);
        if (kind !== "runs" || !run) return problem(response, 404, "there is no such thing");
        if (request.method === "DELETE") {
            this.runs = this.runs.filter((each) => each !== run);
            this.tell(run.id, "remove");
            return json(response, { id: run.id, freed_bytes: 1000 }, 202);
        }
        if (["cancel", "pause", "resume", "retry"].includes(rest[0])) return this.command(run, rest[0], response);
        if (rest[0] === "title") return this.rename(run, request, response);
        if (rest[0] === "triggers") return json(response, { run: run.id, triggers: run.triggers() });
        if (rest[0] === "transfers") return json(response, { transfers: run.transfers(), next: null });
        if (rest[0] === "uncertainty" && run.study.uncertainty) return json(response, run.answer ??= run.uncertainty());
        if (rest[0] === "envelopes" && run.study.uncertainty) return json(response, run.envelopes ??= envelopes_of(run));
        if (rest[0] === "results") return json(response, { run: run.id, verdict: run.summary().verdict, rows: run.rows(), means: run.means(), without_transfer: run.study.without ?? [], same_results: run.study.same ?? [] });
        if (rest[0] === "telemetry") {
            const from = Number(url.searchParams.get("from") ?? 0);
            if (url.searchParams.has("variant")) return problem(response, 400, 'unknown query parameter "variant"');
            const lines = run.telemetry(url.searchParams.get("phase")).slice(from, from + 150);
            return json(response, { lines, next: from + lines.length });
        }
        const computing = Math.max(0, Math.min(run.age(), run.pace));
        const answer = { ...run.summary(), study: run.study, computing_seconds: computing, idle_seconds: run.age() < run.pace ? 0 : 12 };
        return json(response, url.searchParams.get("tasks") === "0" ? answer : { ...answer, tasks: run.tasks.map((task) => run.describe_task(task)) });
    }

    list_runs(url, response) {
        const wanted = (url.searchParams.get("search") ?? "").toLowerCase();
        const all = this.runs.map((run) => run.summary()).reverse()
            .filter(({ name, title, id }) => `${name}\n${title}\n${id}`.toLowerCase().includes(wanted));
        const limit = Math.min(Number(url.searchParams.get("limit") ?? 100), this.most_per_page);
        const from = Number(url.searchParams.get("cursor") ?? 0);
        json(response, { runs: all.slice(from, from + limit), next: from + limit < all.length ? String(from + limit) : null });
    }

    async rename(run, request, response) {
        let text = "";
        for await (const chunk of request) text += chunk;
        const { title } = JSON.parse(text);
        if (!title) return problem(response, 400, "the body must be {\"title\": \"...\"}");
        run.title = title;
        this.tell(run.id, "rename");
        return json(response, run.summary(), 202);
    }

    command(run, order, response) {
        if (order === "cancel") run.cancelled_at ??= Date.now();
        if (order === "pause") run.paused = true;
        if (order === "resume") run.paused = false;
        if (order === "retry") Object.assign(run, { began: Date.now(), pace: 600, cancelled_at: null });
        this.tell(run.id, order);
        json(response, run.summary(), 202);
    }

    serve_artifact(sha256, response) {
        for (const run of this.runs) {
            for (const task of run.tasks) {
                if (digest(`${task.id}profile.csv`) === sha256) return response.writeHead(200).end(profile_of(run.runout(task).runout));
                if (digest(`${task.id}result.json`) === sha256) return json(response, run.result_file(task));
                if (digest(`${task.id}telemetry.jsonl`) !== sha256) continue;
                return response.writeHead(200).end(run.telemetry(task.phase).map((line) => `${JSON.stringify(line)}\n`).join(""));
            }
        }
        return problem(response, 404, "there is no such artifact");
    }

    /// A file is what its name says; an empty one is nothing.
    async answer_files(request, url, response) {
        if (request.method === "GET") return json(response, { files: this.files });
        const text = await text_of(request);
        const name = url.searchParams.get("name");
        if (text === "") return problem(response, 422, "file: 1 fault", [{ pointer: "line 1", cause: "no numbers", remedy: "send two columns" }]);
        const file = { sha256: digest(text), reference: `file:sha256/${digest(text)}.csv`, name, kind: name.endsWith(".msh") ? "mesh" : "motion",
                       about: "PGA 0.31 g, Arias 1.2 m/s", bytes: text.length };
        this.files.unshift(file);
        return json(response, file, 201);
    }

    /// A picture without a section, with the faults of the materials' densities.
    async draw(request, response) {
        const scene = JSON.parse(await text_of(request)).scene ?? {};
        const faults = density_faults(scene).map(({ pointer, cause, remedy }) => `<g data-pointer="${pointer}" data-cause="${cause}" data-remedy="${remedy}"/>`);
        response.writeHead(200, { "Content-Type": "image/svg+xml" });
        response.end(`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 80 20"><title>${scene.name}</title><rect width="80" height="20"/>${faults.join("")}</svg>`);
    }

    async submit(request, response) {
        const text = await text_of(request);
        this.last_submitted = text;
        let body;
        try {
            body = JSON.parse(text);
        } catch (fault) {
            return problem(response, 400, `the body is not JSON: ${fault.message}`);
        }
        const faults = [];
        if (!Array.isArray(body.transfer_times)) {
            faults.push({ pointer: "/transfer_times", cause: "is missing", remedy: "give a list of times in seconds" });
        }
        faults.push(...density_faults(body.scene));
        if (faults.length) return problem(response, 422, "the study has faults", faults);
        return json(response, this.add_run(body).summary(), 202);
    }

    async serve_events(url, response) {
        const after = Number(url.searchParams.get("after"));
        const until = Date.now() + 1000 * Number(url.searchParams.get("wait"));
        while (this.events.length === after && Date.now() < until && !response.destroyed) {
            await new Promise((resume) => setTimeout(resume, 50));
        }
        json(response, { events: this.events.slice(after), next: this.events.length, reset: after > this.events.length });
    }

    serve_task(id, rest, url, response) {
        const run = this.runs.find((candidate) => candidate.tasks.some((task) => task.id === id));
        const task = run?.tasks.find((candidate) => candidate.id === id);
        if (!task) return problem(response, 404, "there is no such task");
        if (rest[0] === "attempts") {
            const lines = Math.floor(60 * run.progress_of(task));
            const text = Array.from({ length: lines }, (_, i) => `[info] ${task.phase} step ${i}\n`).join("");
            const offset = Number(url.searchParams.get("offset") ?? 0);
            response.writeHead(200, { "Content-Type": "text/plain; charset=utf-8", "X-Next-Offset": text.length });
            return response.end(text.slice(offset));
        }
        if (rest[0] !== "frames") return json(response, { ...run.describe_task(task), why: { reason: "first of its kind", differs: [] } });
        if (rest.length === 1) return json(response, { frames: run.frames(task) });
        const bytes = run.points_of(task, Number(rest[1].slice(-5)), Number(url.searchParams.get("stride") ?? 1));
        response.writeHead(200, { "Content-Type": "application/octet-stream" });
        return response.end(bytes);
    }

    async serve_file(response, name) {
        const file = path.join(static_folder, name === "/" ? "index.html" : name.replace(/^\/static\//, ""));
        if (!file.startsWith(static_folder)) return problem(response, 404, "outside");
        const body = await readFile(file).catch(() => null);
        if (!body) return problem(response, 404, "there is no such file");
        response.writeHead(200, { "Content-Type": content_types[path.extname(file)] ?? "application/octet-stream", ...(name === "/" ? {} : { "Cache-Control": "max-age=3600" }) });
        return response.end(body);
    }
}

async function text_of(request) {
    let text = "";
    for await (const chunk of request) text += chunk;
    return text;
}

const density_faults = (scene) => Object.entries(scene?.materials ?? {}).filter(([, material]) => material.density < 0).map(([name, { density }]) =>
    ({ pointer: `/scene/materials/${name}/density`, cause: `${density} kg/m3 is below 0`, remedy: "a soil weighs 1,200 to 2,400 kg/m3" }));

function json(response, body, status = 200) {
    response.writeHead(status, { "Content-Type": "application/json" });
    response.end(JSON.stringify(body));
}

function problem(response, status, detail, faults = []) {
    response.writeHead(status, { "Content-Type": "application/problem+json" });
    response.end(JSON.stringify({ type: "/problems/bad-input", title: "Bad input", status, detail, faults }));
}
