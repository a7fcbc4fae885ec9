// The profile along a cut through the soil: ends by two clicks or as numbers, curve, CSV.
import { by_id, set_text } from "./dom.js";
import { values_along } from "./cut.js";
import { field_label, field_name, is_named, unit_of } from "./fields.js";
import { seconds } from "./format.js";
import { offer_file } from "./download.js";
import { Plot } from "./plot.js";

const inputs = ["cut-x1", "cut-y1", "cut-x2", "cut-y2"];

export class Profile {
    /// view: the PointView that shows the cut and receives the clicks.
    constructor(view) {
        this.view = view;
        this.plot = new Plot(by_id("profile-plot"), { title: "Profile", x: "distance from A along the cut [m]", y: "", x_name: "from A", x_unit: "m" },
                             { height: 240 });
        for (const id of inputs) by_id(id).addEventListener("input", () => this.read_inputs());
        by_id("cut-pick").addEventListener("click", () => (this.view.pick ? this.stop_picking() : this.start_picking()));
        by_id("cut-clear").addEventListener("click", () => this.clear());
        by_id("profile-csv").addEventListener("click", () => this.offer_csv());
        view.canvas.addEventListener("keydown", (event) => event.key === "Escape" && this.stop_picking());
    }

    start_picking() {
        const ends = [];
        set_text(by_id("cut-message"), "Click where the cut begins (A), then where it ends (B).");
        set_text(by_id("cut-pick"), "Stop clicking");
        this.view.pick = (place) => {
            ends.push(place.map((each) => Number(each.toFixed(3))));
            set_text(by_id("cut-message"), "Now click where it ends (B).");
            if (ends.length < 2) return;
            ends.flat().forEach((value, i) => (by_id(inputs[i]).value = value));
            this.stop_picking();
            this.read_inputs();
        };
    }

    stop_picking() {
        this.view.pick = null;
        set_text(by_id("cut-pick"), "Two clicks");
        set_text(by_id("cut-message"), "");
    }

    read_inputs() {
        const [x1, y1, x2, y2] = inputs.map((id) => (by_id(id).value === "" ? NaN : Number(by_id(id).value)));
        const whole = [x1, y1, x2, y2].every(Number.isFinite) && (x1 !== x2 || y1 !== y2);
        this.view.overlay.cut = whole ? [[x1, y1], [x2, y2]] : null;
        this.view.redraw();
        this.draw();
    }

    clear() {
        for (const id of inputs) by_id(id).value = "";
        this.stop_picking();
        this.read_inputs();
    }

    /// Shows the profile of the present picture. of: its subject in words.
    show(snapshot, field, spacing, of) {
        Object.assign(this, { snapshot, field, spacing, of });
        this.draw();
    }

    draw() {
        const ends = this.view.overlay.cut;
        const wanted = Boolean(ends && this.snapshot && !is_named(this.field));
        by_id("profile").hidden = !wanted;
        if (ends && this.snapshot) set_text(by_id("cut-message"), wanted ? "" : "A region or material has no profile: choose another field.");
        if (!wanted) return;
        const cut = values_along(this.snapshot, this.field, ends, this.spacing);
        this.cut = cut;
        const known = cut.value.filter((value) => value !== null).length;
        const how = this.snapshot.quads ? "interpolated in the displaced mesh" : "of the next point, none further away than their spacing";
        set_text(by_id("profile-title"), `${field_name(this.field)} along A–B at ${seconds(this.snapshot.time)}`);
        set_text(by_id("profile-note"), known ? `${this.of}; ${how}. Gaps: no soil, or no value there.` : "The cut meets no soil that has this value.");
        by_id("profile-csv").disabled = known === 0;
        this.plot.labels.y = field_label(this.field);
        this.plot.show({ series: [{ name: field_name(this.field), unit: unit_of(this.field), x: cut.distance, y: cut.value }] });
    }

    offer_csv() {
        const { cut, field } = this;
        const head = ["distance [m]", "x [m]", "y [m]", field_label(field)].map((name) => `"${name}"`).join(",");
        const lines = cut.distance.map((distance, i) => [distance, cut.x[i], cut.y[i], cut.value[i] ?? ""].map((value) =>
            (value === "" ? "" : Number(value.toPrecision(7)))).join(","));
        const about = `# ${field_name(field)} at ${this.snapshot.time} s, ${this.of}`;
        offer_file(`profile_${field}_${this.snapshot.time}s.csv`, new Blob([[about, head, ...lines].join("\r\n") + "\r\n"], { type: "text/csv" }));
    }
}
