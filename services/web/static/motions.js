// Findings of a study of several motions, from the service.
import { read_motions } from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { number } from "./format.js";
import { Plot } from "./plot.js";

const fewest_fems = 5;
const interval = (found) => (found ? `${number(found.value, 2)} (${number(found.low, 2)} to ${number(found.high, 2)})` : "–");
const median = ({ unit, fragility }) => (fragility.refused ? "–" : `${number(fragility.median, 3)} ${unit} (${number(fragility.low, 3)} to ${number(fragility.high, 3)})`);

export class Motions {
    constructor() {
        this.choice = by_id("motions-measure");
        this.choice.addEventListener("change", () => this.draw());
        this.plots = [
            { column: "liquefaction_depth", unit: "m", plot: new Plot(by_id("motions-depth"), { y: "liquefied depth [m]", title: "Liquefied depth against a measure of the motion" }, { height: 260 }) },
            { column: "runout", unit: "m", plot: new Plot(by_id("motions-runout"), { x: "liquefied depth [m]", x_name: "depth", x_unit: "m", y: "runout past the toe [m]", title: "Runout against liquefied depth" }, { height: 260 }), against: "liquefaction_depth" },
        ];
    }

    async show(run) {
        const fems = run.tasks.filter(({ phase, state }) => phase === "fem_solver" && (state === "succeeded" || state === "cached"));
        this.found = fems.length < fewest_fems ? null : await read_motions(run.id);
        by_id("motions").hidden = !this.found;
        if (!this.found) return;
        mirror(by_id("motions-said"), this.found.sentences, (said) => said, () => element("li"), set_text);
        mirror(by_id("motions-rows"), this.found.measures, ({ name }) => name, () => element("tr", {}, element("th", { scope: "row" }), ...Array.from({ length: 3 }, () => element("td"))),
               (row, measure) => {
                   [measure.title, interval(measure.with_depth), interval(measure.with_runout), median(measure)].forEach((text, i) => set_text(row.children[i], text));
                   row.lastElementChild.title = measure.fragility.refused ?? "";
               });
        if (this.choice.options.length === 0) {
            for (const { name, title, unit } of this.found.measures) this.choice.append(element("option", { value: name }, `${title} [${unit}]`));
            if (this.found.best) this.choice.value = this.found.best;
        }
        this.draw();
    }

    draw() {
        const { title, unit, name } = this.found.measures.find((each) => each.name === this.choice.value);
        for (const { column, unit: of_y, plot, against } of this.plots) {
            if (!against) Object.assign(plot.labels, { x: `${title} [${unit}]`, x_name: title, x_unit: unit });
            const rows = this.found.rows.filter((row) => Number.isFinite(row[column]));
            plot.show({ series: [{ name: "motions", unit: of_y, points: true, scatter: true, names: rows.map((row) => row.variant || "the scene's"),
                                   looks: rows.map((row) => (column === "runout" && row.lower_bound ? "bound" : "")),
                                   x: rows.map((row) => row[against ?? name]), y: rows.map((row) => row[column]) }] });
        }
    }
}
