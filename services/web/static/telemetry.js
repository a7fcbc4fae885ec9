// Telemetry of a phase as small curves against time, updated while it runs, with the thresholds of the run's triggers and the times at
// which they fired.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { by_point, is_active, mpm_name, number, variants_of } from "./format.js";
import { abscissas, is_other, panels } from "./panels.js";
import { Plot } from "./plot.js";
import { fem_of, fems_of } from "./provenance.js";
import { draw_triggers, moments, thresholds, windows } from "./triggers.js";

export class Telemetry {
    constructor() {
        this.plots = new Map(); // panel title -> Plot
        this.fems = new Map(); // transfer task -> FEM task
        by_id("telemetry-source").addEventListener("change", (event) => {
            this.by_hand = true;
            this.open(event.target.value);
        });
        this.forget();
    }

    forget() {
        this.columns = new Map(); // field -> one value per line; null: missing
        this.count = 0;
        this.next = 0;
        this.refusal = "";
    }

    /// governing: the row whose FEM, or else MPM, is shown first; null: none yet.
    async show(run, governing) {
        if (this.run?.id !== run.id) this.task = this.by_hand = null;
        this.run = run;
        draw_triggers(run.triggers);
        const sources = run.tasks.filter((task) => task.phase === "fem_solver" || task.phase === "mpm_solver")
            .sort(by_point(variants_of(run)));
        mirror(by_id("telemetry-source"), sources, (task) => task.id, (task) => element("option", { value: task.id }),
               (option, task) => set_text(option, source_name(task)));
        by_id("telemetry").hidden = sources.length === 0; // a stability analysis has none
        const fems = await fems_of(run);
        if (this.run !== run) return;
        this.fems = fems;
        const transfer = run.tasks.find(({ id }) => id && id === governing?.transfer_task);
        const first = (transfer && fem_of(run, transfer, fems, governing.variant)) ?? governing?.mpm_task;
        const current = sources.find((task) => task.id === this.task);
        const chosen = (this.by_hand && current) || (sources.find((task) => task.id === first) ?? current ?? sources[0]);
        if (!chosen) return;
        if (chosen.id !== this.task) await this.open(chosen.id);
        else if (is_active(chosen.state) || this.was_active) await this.extend();
        else this.draw();
        this.was_active = is_active(chosen.state);
    }

    async open(task) {
        this.task = task;
        by_id("telemetry-source").value = task;
        this.forget();
        set_text(by_id("telemetry-message"), "Loading…");
        await this.extend();
    }

    chosen() {
        return this.run.tasks.find((candidate) => candidate.id === this.task);
    }

    /// Reads the new lines.
    async extend() {
        const task = this.chosen();
        const alone = is_alone(this.run, task);
        for (;;) {
            const from = this.next;
            let answer;
            try {
                answer = await api.read_telemetry(task, alone, from);
            } catch (fault) {
                if (!(fault instanceof api.Problem) || fault.status !== 400) throw fault;
                if (this.task === task.id) this.refuse();
                return;
            }
            const { lines, next } = answer;
            if (this.task !== task.id || this.next !== from) return;
            if (next < from) this.forget(); // a new attempt began a new file
            else this.append(lines);
            this.next = next;
            if (lines.length === 0 || next <= from) break;
        }
        this.draw();
    }

    refuse() {
        this.refusal = "This server tells the telemetry of variants apart only when their tasks have ended.";
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
        set_text(by_id("telemetry-message"), this.count > 0 ? "" : this.refusal || "No telemetry yet.");
        const shown = x_field ? panels.filter((panel) => Object.keys(panel.fields).some((f) => this.columns.has(f))) : [];
        const others = x_field ? [...this.columns.keys()].filter(is_other) : [];
        const all = [...shown.map((panel) => ({ ...panel, host: "telemetry-plots" })),
                     ...others.map((field) => ({ title: field, y: field, unit: "", fields: { [field]: field },
                                                 host: "telemetry-others" }))];
        this.find_overlay();
        for (const host of ["telemetry-plots", "telemetry-others"]) {
            mirror(by_id(host), all.filter((panel) => panel.host === host), (panel) => panel.title,
                   (panel) => this.new_panel(panel), (figure, panel) => this.fill(panel, x_field));
        }
        by_id("telemetry-more").hidden = others.length === 0;
    }

    /// Marks for the curves of the chosen FEM; triggers watch nothing else.
    find_overlay() {
        const task = this.chosen();
        this.overlay = { levels: [], lines: [], bands: [] };
        if (task?.phase !== "fem_solver") return;
        const triggers = this.run.triggers.filter((trigger) => trigger.fem_task === task.id);
        const transfers = this.run.tasks.filter((other) => other.phase === "transfer_tool" &&
                                                           fem_of(this.run, other, this.fems) === task.id);
        this.overlay = {
            levels: thresholds(triggers),
            lines: [...transfers.map((other) => ({ x: other.transfer_time, label: `transfer at ${number(other.transfer_time)} s` })),
                    ...moments(triggers)],
            bands: windows(triggers),
        };
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
        const levels = this.overlay.levels.filter(({ field }) => field in panel.fields);
        this.plots.get(panel.title).show({ series, ...this.overlay, levels });
    }
}

function source_name(task) {
    if (task.phase === "fem_solver") return task.variant ? `FEM, ${task.variant}` : "FEM";
    return mpm_name(task);
}

/// Whether no other task of the run has the same phase and transfer time.
export const is_alone = (run, task) =>
    run.tasks.filter((other) => other.phase === task.phase && other.transfer_time === task.transfer_time).length === 1;
