// Telemetry of a phase as small curves against time, growing while it runs.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { is_active, number } from "./format.js";
import { Plot } from "./plot.js";

// What is drawn first, and how it is called. A panel appears when at least one of its fields is in the lines.
const panels = [
    { title: "Crest displacement", y: "displacement [m]", unit: "m",
      fields: { crest_dx: "horizontal", crest_dy: "vertical", crest_displacement: "total" } },
    { title: "Kinetic energy", y: "kinetic energy [J]", unit: "J", fields: { kinetic_energy: "kinetic" } },
    { title: "Jacobian ratio, averages", y: "|J_t| / |J_0| [–]", unit: "",
      fields: { jacobian_ratio_avg: "strained elements", jacobian_least_avg: "their worst corners" } },
    { title: "Deviatoric strain, average", y: "ε_q [–]", unit: "", fields: { epsilon_q_avg: "strained elements" } },
    { title: "Front", y: "distance from the toe [m]", unit: "m",
      fields: { runout: "99 % of the mobile soil", runout_beyond_toe: "99 % of what passed the toe",
                runout_largest: "farthest point" } },
    { title: "Where the energy went", y: "energy [J]", unit: "J",
      fields: { plastic_dissipation: "plastic", friction_dissipation: "floor friction", energy_numerical: "numerical" } },
];
const not_drawn = ["step", "stage"]; // counters
const named = new Set(panels.flatMap((panel) => Object.keys(panel.fields)));
const abscissas = ["time", "t"];

export class Telemetry {
    constructor() {
        this.plots = new Map(); // panel title -> Plot
        by_id("telemetry-source").addEventListener("change", (event) => this.open(event.target.value));
        this.forget();
    }

    forget() {
        this.columns = new Map(); // field -> values, one per line; null where a line has none
        this.count = 0;
        this.next = 0;
    }

    async show(run) {
        if (this.run?.id !== run.id) this.task = null;
        this.run = run;
        const sources = run.tasks.filter((task) => task.phase === "fem_solver" || task.phase === "mpm_solver");
        mirror(by_id("telemetry-source"), sources, (task) => task.id, (task) => element("option", { value: task.id }),
               (option, task) => set_text(option, task.phase === "fem_solver" ? "FEM"
                                                 : `MPM from t_T = ${number(task.transfer_time)} s`));
        const chosen = sources.find((task) => task.id === this.task) ?? sources[0];
        if (!chosen) return;
        if (chosen.id !== this.task) await this.open(chosen.id);
        else if (is_active(chosen.state) || this.was_active) await this.extend();
        this.was_active = is_active(chosen.state);
    }

    async open(task) {
        this.task = task;
        by_id("telemetry-source").value = task;
        this.forget();
        await this.extend();
    }

    /// Takes the lines written since the last look.
    async extend() {
        const task = this.run.tasks.find((candidate) => candidate.id === this.task);
        for (;;) {
            const from = this.next;
            const { lines, next } = await api.read_telemetry(this.run.id, task.phase, task.transfer_time ?? null, from);
            if (this.task !== task.id || this.next !== from) return;
            if (next < from) this.forget(); // a new attempt began its own file
            else this.append(lines);
            this.next = next;
            if (lines.length === 0 || next <= from) break;
        }
        this.draw();
    }

    append(lines) {
        for (const line of lines) {
            for (const [field, value] of Object.entries(line)) {
                if (typeof value !== "number") continue;
                if (!this.columns.has(field)) this.columns.set(field, new Array(this.count).fill(null));
                this.columns.get(field)[this.count] = value;
            }
            this.count += 1;
            for (const values of this.columns.values()) if (values.length < this.count) values.push(null);
        }
    }

    draw() {
        const x_field = abscissas.find((field) => this.columns.has(field));
        set_text(by_id("telemetry-message"), this.count === 0 ? "No telemetry yet." : "");
        const shown = x_field ? panels.filter((panel) => Object.keys(panel.fields).some((f) => this.columns.has(f))) : [];
        const others = x_field ? [...this.columns.keys()].filter((f) => !named.has(f) && !not_drawn.includes(f) && !abscissas.includes(f)) : [];
        const all = [...shown.map((panel) => ({ ...panel, host: "telemetry-plots" })),
                     ...others.map((field) => ({ title: field, y: field, unit: "", fields: { [field]: field },
                                                 host: "telemetry-others" }))];
        for (const host of ["telemetry-plots", "telemetry-others"]) {
            mirror(by_id(host), all.filter((panel) => panel.host === host), (panel) => panel.title,
                   (panel) => this.new_panel(panel), (figure, panel) => this.fill(panel, x_field));
        }
        by_id("telemetry-more").hidden = others.length === 0;
    }

    new_panel(panel) {
        const host = element("div");
        this.plots.set(panel.title, new Plot(host, {
            title: panel.title, x: "time [s]", y: panel.y, x_name: "t", x_unit: "s", lines: "transfer",
        }, { height: 220 }));
        return element("figure", {}, element("figcaption", {}, panel.title), host);
    }

    fill(panel, x_field) {
        const x = this.columns.get(x_field);
        const series = Object.entries(panel.fields).filter(([field]) => this.columns.has(field))
            .map(([field, name]) => ({ name, unit: panel.unit, points: false, x, y: this.columns.get(field) }));
        const is_fem = this.run.tasks.find((task) => task.id === this.task)?.phase === "fem_solver";
        const lines = !is_fem ? [] : this.run.tasks.filter((task) => task.phase === "transfer_tool")
            .map((task) => ({ x: task.transfer_time, label: `transfer at ${number(task.transfer_time)} s` }));
        this.plots.get(panel.title).show({ series, lines });
    }
}
