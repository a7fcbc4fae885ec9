// Gauges of the shown runout: flow depth and velocity against time, with a mark at the picture's time.
import * as api from "./api.js";
import { by_id, set_text } from "./dom.js";
import { number, seconds } from "./format.js";
import { Plot } from "./plot.js";
import { is_alone } from "./telemetry.js";

const quantities = { depth: { host: "gauge-depth", y: "flow depth [m]", unit: "m" },
                     velocity: { host: "gauge-velocity", y: "velocity [m/s]", unit: "m/s" } };

export class Gauges {
    constructor() {
        this.plots = Object.fromEntries(Object.entries(quantities).map(([quantity, { host, y }]) =>
            [quantity, new Plot(by_id(host), { title: y, x: "time since the runout began [s]", y, x_name: "t", x_unit: "s" }, { height: 190, y_from_zero: true })]));
    }

    /// Shows a task of the run, with its scene; nothing for a FEM or a scene without gauges.
    async show(run, task, scene) {
        const gauges = task?.phase === "mpm_solver" ? scene?.mpm?.gauges ?? [] : [];
        by_id("gauges").hidden = gauges.length === 0;
        if (gauges.length === 0) return;
        if (this.task !== task.id) Object.assign(this, { task: task.id, lines: [], next: 0 });
        await this.read(run, task);
        if (this.task === task.id) this.draw(gauges);
    }

    async read(run, task) {
        for (;;) {
            const from = this.next;
            let answer;
            try {
                answer = await api.read_telemetry(task, is_alone(run, task), from);
            } catch (fault) {
                if (!(fault instanceof api.Problem) || fault.status !== 400) throw fault;
                if (this.task === task.id) this.lines = [];
                return;
            }
            if (this.task !== task.id || this.next !== from) return;
            if (answer.next < from) this.lines = []; // a new attempt began a new file
            else this.lines.push(...answer.lines);
            this.next = answer.next;
            if (answer.lines.length === 0 || answer.next <= from) return;
        }
    }

    draw(gauges) {
        const of = (gauge, quantity) => `gauge.${gauge.name}.${quantity}`;
        const seen = this.lines.filter((line) => gauges.some((gauge) => Number.isFinite(line[of(gauge, "depth")])));
        const x = seen.map((line) => line.time ?? line.t);
        for (const [quantity, { unit }] of Object.entries(quantities)) {
            const series = gauges.map((gauge) => ({ name: `${gauge.name} (x = ${number(gauge.x)} m)`, unit, x,
                                                    y: seen.map((line) => line[of(gauge, quantity)] ?? null) }));
            this.plots[quantity].show({ series });
            this.plots[quantity].mark_now(this.now);
        }
        set_text(by_id("gauges-note"), seen.length === 0 ? "No gauge has a value yet."
            : "Means over a cell each way, of the mobile soil: its depth, and its horizontal velocity by mass. Where there is none, both are 0. " +
              `Recorded to ${seconds(x.at(-1))}.`);
    }

    /// Moves the mark to the picture's time.
    mark(time) {
        this.now = time;
        for (const plot of Object.values(this.plots)) plot.mark_now(time);
    }
}
