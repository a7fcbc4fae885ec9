// Error against run time: the cost of each point of the sweep, its error indicators, and the CPU time of the run by phase.
import { by_id, element, mirror, set_text } from "./dom.js";
import { flag_note, look_of } from "./flags.js";
import { number, point_name, seconds } from "./format.js";
import { Plot } from "./plot.js";
import { key_of, series_by_variant } from "./results.js";

const phases = ["lem_tool", "fem_solver", "post_seismic", "transfer_tool", "mpm_solver"];
const axis = { x: "CPU time of the MPM run [s]", x_name: "CPU", x_unit: "s",
               hint: "One marker per transfer time and variant; click or Enter shows where it comes from." };

export class Cost {
    /// ask(key, column): called to show where a point comes from.
    constructor(ask) {
        const with_plot = (id, title, entry) => ({ ...entry, plot: new Plot(by_id(id), { ...axis, y: entry.y, title },
                                                                            { height: 260, choose: (_, key) => key && ask(key, entry.column) }) });
        this.plots = [
            with_plot("cost-runout", "Runout against CPU time",
                      { y: "runout from the toe [m]", column: "runout", error: "runout_error", unit: "m" }),
            with_plot("cost-share", "Numerical share against CPU time",
                      { y: "numerical share [–]", column: "numerical_share", unit: "" }),
        ];
    }

    show(run, rows, variants) {
        const finished = rows.filter((row) => Number.isFinite(row.runout) && Number.isFinite(row.cpu_seconds));
        const has_error = finished.some((row) => Number.isFinite(row.runout_error));
        set_text(by_id("cost-runout-title"), has_error ? "Error estimate of the runout" : "Runout (the results carry no error estimate)");
        by_id("cost-plots").hidden = finished.length < 2;
        by_id("cost-none").hidden = finished.length > 0;
        set_text(by_id("cost-none"), run.tasks.some(({ phase }) => phase === "lem_tool") && run.tasks.every(({ phase }) => phase === "lem_tool")
            ? "A stability analysis alone: no runout is asked for." : "No runout is known yet.");
        for (const { plot, y, column, error, unit } of this.plots) {
            const field = error && has_error ? error : column;
            plot.labels.y = field === "runout_error" ? "error estimate of the runout [m]" : y;
            const lines = run.study?.uncertainty ? [{ variant: "samples", rows: finished }] : series_by_variant(finished, variants);
            plot.show({ series: lines.map(({ variant, rows: points }) => ({
                name: variant || "transfer times", unit, points: true, scatter: true, keys: points.map(key_of),
                looks: points.map((row) => (column === "runout" ? look_of(row) : look_of(row).replace(/.*bound.*/, "doubtful"))), notes: points.map(flag_note),
                names: points.map((row) => (run.study?.uncertainty ? row.variant : point_name({ ...row, variant: "" }) || "the section")),
                x: points.map((row) => row.cpu_seconds), y: points.map((row) => row[field] ?? null) })) });
        }
        draw_totals(run.tasks);
    }
}

/// CPU seconds of all attempts, including failed ones.
function totals_of(tasks) {
    return phases.map((phase) => {
        const own = tasks.filter((task) => task.phase === phase);
        const attempts = own.flatMap((task) => task.attempts);
        const sum = (name) => attempts.reduce((total, attempt) => total + (attempt[name] ?? 0), 0);
        return { phase, tasks: own.length, reused: own.filter((task) => task.state === "cached").length,
                 attempts: attempts.length, cpu: sum("cpu_seconds"), wall: sum("wall_seconds") };
    }).filter((total) => total.tasks > 0);
}

function draw_totals(tasks) {
    const totals = totals_of(tasks);
    const all = totals.reduce((sum, total) => sum + total.cpu, 0);
    mirror(by_id("cost-rows"), totals, (total) => total.phase, () => element("tr", {}, element("th", { scope: "row" }),
           ...Array.from({ length: 5 }, () => element("td", { class: "number" })),
           element("td", { class: "share" }, element("meter", { min: 0, max: 1 }), " ", element("span", { class: "number" }))),
           (row, { phase, tasks: count, reused, attempts, cpu, wall }) => {
               [phase, count, reused, attempts, seconds(cpu), seconds(wall)].forEach((text, i) => set_text(row.children[i], String(text)));
               const share = all > 0 ? cpu / all : 0;
               row.lastElementChild.firstElementChild.value = share;
               row.lastElementChild.firstElementChild.setAttribute("aria-label", `share of ${phase}`);
               set_text(row.lastElementChild.lastElementChild, `${number(100 * share, 3)} %`);
           });
    set_text(by_id("cost-sum"), `${seconds(all)} of CPU time in all.`);
}
