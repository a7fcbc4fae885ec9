// Runout against transfer time: the curve, its table, its CSV.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { is_active, number, show_state, state_look } from "./format.js";
import { Plot } from "./plot.js";

const curves = [
    { field: "runout", name: "99 % of the mobile soil" },
    { field: "runout_beyond_toe", name: "99 % of what passed the toe" },
    { field: "runout_largest", name: "farthest point" },
];
const columns = ["runout", "runout_beyond_toe", "runout_largest", "volume_ratio", "numerical_share", "cpu_seconds"];

export class Results {
    /// choose(transfer_time): a person wants to see this one's particles.
    constructor(choose) {
        this.choose = choose;
        this.plot = new Plot(by_id("runout-plot"), {
            title: "Runout", x: "transfer time t_T [s]", y: "runout from the toe [m]", x_name: "t_T", x_unit: "s",
            hint: "Point at the curve, or use the arrow keys; click or Enter shows the particles.",
        }, { height: 320, choose, y_from_zero: true });
    }

    async show(run) {
        const { rows } = await api.read_results(run.id);
        by_id("runout-csv").href = api.results_csv(run.id);
        rows.sort((a, b) => a.transfer_time - b.transfer_time);
        const x = rows.map((row) => row.transfer_time);
        const there = curves.filter(({ field }) => rows.some((row) => Number.isFinite(row[field])));
        this.plot.show({
            series: there.map(({ field, name }) => ({ name, unit: "m", points: true, x,
                                                      y: rows.map((row) => row[field] ?? null) })),
            marks: rows.filter((row) => !Number.isFinite(row.runout)).map(mark_of),
        });
        const finished = rows.filter((row) => Number.isFinite(row.runout)).length;
        set_text(by_id("runout-progress"), `${finished} of ${rows.length} transfer times finished`);
        mirror(by_id("runout-rows"), rows, (row) => row.transfer_time, () => this.new_row(), fill_row);
    }

    new_row() {
        const look = element("button", { type: "button", class: "link",
                                         onclick: () => this.choose(Number(row.dataset.key)) });
        const row = element("tr", {}, element("th", { scope: "row" }, look), element("td", {}, element("span")));
        for (const column of columns) row.append(element("td", { class: "number", "data-column": column }));
        return row;
    }
}

function mark_of(row) {
    const kinds = { failed: "failed", lost: "failed", skipped: "skipped", cancelled: "skipped", cancelling: "skipped" };
    const busy = state_look(row.state).family === "busy" ? "running" : "pending";
    return { x: row.transfer_time, kind: kinds[row.state] ?? busy,
             label: row.reason ? `${row.state}: ${row.reason}` : row.state };
}

function fill_row(row, values) {
    const [time, state] = row.children;
    const look = time.firstElementChild;
    set_text(look, number(values.transfer_time));
    look.disabled = !values.mpm_task || ["blocked", "ready", "skipped"].includes(values.state);
    look.title = "Show the particles";
    show_state(state.firstElementChild, values.state);
    state.title = values.reason ?? "";
    for (const cell of row.querySelectorAll("[data-column]")) set_text(cell, number(values[cell.dataset.column]));
    row.classList.toggle("waiting", is_active(values.state));
}
