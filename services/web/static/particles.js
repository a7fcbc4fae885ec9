// The moving picture of a run: which task, which snapshot, coloured by what. Fetches snapshots and keeps the recent
// ones; the drawing itself is in points.js.
import * as api from "./api.js";
import { region_css, scale_gradient } from "./colours.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { by_point, is_active, mpm_name, number, seconds, variants_of } from "./format.js";
import { extents_of, PointView, reach_of, spacing_of } from "./points.js";

const frames_per_second = 12;
const kept_bytes = 192e6;       // snapshots kept in memory
const easy_count = 250000;      // more points than this are thinned at first sight
const ahead = 2;                // snapshots fetched before a playing picture needs them

const known_fields = {
    epsilon_q: { name: "deviatoric strain ε_q", unit: "–" },
    speed: { name: "velocity (magnitude)", unit: "m/s" },
    region: { name: "region", unit: "" },
    material: { name: "material", unit: "" },
    r_u: { name: "pore pressure ratio r_u", unit: "–" },
    pore_pressure: { name: "pore pressure u", unit: "Pa" },
    mean_stress: { name: "mean effective stress", unit: "Pa" },
};
const categories = ["region", "material"];
const field_name = (field) => known_fields[field]?.name ?? field;

export class Particles {
    constructor() {
        this.view = new PointView(by_id("view"));
        this.task = null;
        this.frames = [];
        this.at = -1;
        this.kept = new Map(); // frame name -> {snapshot, bytes}, oldest first
        this.reaches = {};     // field -> [low, high] end of its scale so far
        this.coming = new Map(); // key -> snapshot that is being fetched
        this.times = new Map(); // frame name -> time in the file
        by_id("view-source").addEventListener("change", (event) => this.choose(event.target.value));
        by_id("view-field").addEventListener("change", (event) => {
            this.field = event.target.value;
            this.paint();
        });
        by_id("view-stride").addEventListener("change", () => this.reload());
        by_id("view-time").addEventListener("input", (event) => this.seek(Number(event.target.value)));
        by_id("view-play").addEventListener("click", () => (this.playing ? this.pause() : this.play()));
        by_id("view-in").addEventListener("click", () => this.view.zoom(1.25));
        by_id("view-out").addEventListener("click", () => this.view.zoom(0.8));
        by_id("view-fit").addEventListener("click", () => this.view.fit());
        for (const id of ["view-low", "view-high"]) by_id(id).addEventListener("change", () => this.paint());
        by_id("view-auto").addEventListener("change", () => this.paint());
    }

    /// Another run, or the same one further on.
    async show(run) {
        const same = this.run?.id === run.id;
        this.run = run;
        if (!same) this.close();
        const sources = run.tasks.filter((task) => task.phase === "fem_solver" || task.phase === "mpm_solver")
            .sort(by_point(variants_of(run)));
        mirror(by_id("view-source"), sources, (task) => task.id,
               (task) => element("option", { value: task.id }), (option, task) => set_text(option, source_name(task)));
        by_id("particles").hidden = sources.length === 0;
        const scene = run.study?.scene;
        this.materials = new Map((scene?.section?.regions ?? []).map(({ name, material }) => [name, material]));
        this.view.overlay = { outlines: (scene?.section?.regions ?? []).map((region) => region.polygon),
                              toe: scene?.mpm?.runout?.toe ?? null };
        const best = first_with_frames(sources);
        const current = sources.find((task) => task.id === this.task);
        // Until a person chooses, the mesh gives way to the first runout that there is.
        const follow = !current || (!this.by_hand && current.phase === "fem_solver" && !this.playing);
        const chosen = follow ? best : current;
        if (!chosen) return;
        if (chosen.id !== this.task) await this.open(chosen.id);
        else if (is_active(chosen.state) || this.frames.length === 0 || this.was_active) await this.extend();
        this.was_active = is_active(chosen.state);
    }

    /// The particles of one point of the sweep, asked for elsewhere on the page.
    show_point(row) {
        if (row.mpm_task) this.choose(row.mpm_task);
    }

    choose(task) {
        this.by_hand = true;
        return this.open(task);
    }

    close() {
        this.pause();
        this.task = null;
        this.by_hand = false;
        this.forget();
        this.tell("");
    }

    forget() {
        this.abort?.abort();
        this.frames = [];
        this.at = -1;
        this.kept.clear();
        this.times.clear();
        this.reaches = {};
        this.coming.clear();
        this.box_frames = "";
        this.view.snapshot = null;
        this.view.box = null;
        this.view.fitted = true;
        this.view.redraw();
        this.update_controls();
    }

    async open(task) {
        this.pause();
        this.task = task;
        by_id("view-source").value = task;
        this.forget();
        await this.extend();
    }

    async reload() {
        const at = this.at;
        this.kept.clear();
        await this.seek(at);
    }

    /// Looks for new snapshots; stays with the newest one when it was shown.
    async extend() {
        const task = this.task;
        const frames = last_state_last(await api.list_frames(task));
        if (task !== this.task) return;
        for (const frame of frames) frame.time = this.times.get(frame.name) ?? frame.time;
        const at_end = this.at === this.frames.length - 1;
        const grew = frames.length !== this.frames.length;
        this.frames = frames;
        if (frames.length === 0) {
            this.tell("No snapshots yet.");
            this.update_controls();
            return;
        }
        this.tell("");
        if (grew) await this.find_box();
        if (this.at < 0 || (at_end && grew && !this.playing)) await this.seek(frames.length - 1);
        else this.update_controls();
    }

    /// The picture must not jump while it plays: it shows where the soil begins and where it ends.
    async find_box() {
        const ends = [this.frames[0].name, this.frames.at(-1).name];
        if (ends.join() === this.box_frames) return;
        const snapshots = [];
        for (const name of new Set(ends)) snapshots.push(await this.fetch(name));
        if (snapshots.some((snapshot) => !snapshot)) return;
        this.box_frames = ends.join();
        const box = extents_of(snapshots);
        if (!box) return;
        this.size_canvas(box);
        this.view.set_box(box);
        this.spacing = spacing_of(snapshots[0]);
    }

    /// A flat runout gets a flat picture.
    size_canvas(box) {
        const slenderness = (box.y[1] - box.y[0]) / Math.max(box.x[1] - box.x[0], 1e-9);
        by_id("view").style.setProperty("--slenderness", Math.min(0.75, Math.max(0.2, slenderness * 1.04)));
    }

    stride() {
        return Number(by_id("view-stride").value);
    }

    async fetch(name) {
        const key = `${name}/${this.stride()}`;
        if (this.kept.has(key)) {
            const entry = this.kept.get(key);
            this.kept.delete(key); // to the young end
            this.kept.set(key, entry);
            return entry.snapshot;
        }
        if (!this.coming.has(key)) {
            const coming = this.get(name, key).finally(() => this.coming.get(key) === coming && this.coming.delete(key));
            this.coming.set(key, coming);
        }
        return this.coming.get(key);
    }

    async get(name, key) {
        this.abort ??= new AbortController();
        if (this.abort.signal.aborted) this.abort = new AbortController();
        const task = this.task;
        let snapshot;
        try {
            snapshot = await api.read_points(task, name, this.stride(), this.abort.signal);
        } catch (fault) {
            if (fault.name === "AbortError") return null;
            throw fault;
        }
        if (task !== this.task) return null;
        if (snapshot.count > easy_count && this.kept.size === 0 && this.stride() === 1) {
            by_id("view-stride").value = "4";
            return this.fetch(name);
        }
        add_material(snapshot, this.materials);
        this.keep(key, snapshot);
        return snapshot;
    }

    keep(key, snapshot) {
        this.kept.set(key, { snapshot, bytes: 4 * snapshot.count * Object.keys(snapshot.columns).length });
        let total = [...this.kept.values()].reduce((sum, entry) => sum + entry.bytes, 0);
        for (const [oldest, entry] of this.kept) {
            if (total <= kept_bytes || this.kept.size <= 2) break;
            this.kept.delete(oldest);
            total -= entry.bytes;
        }
        for (const [field, values] of Object.entries(snapshot.columns)) {
            if (["x", "y", ...categories].includes(field)) continue;
            const [low, high] = reach_of(values);
            const [lowest, highest] = this.reaches[field] ?? [0, 0];
            this.reaches[field] = [Math.min(low, lowest), Math.max(high, highest)];
        }
    }

    async seek(index) {
        const frame = this.frames[index];
        if (!frame) return;
        this.at = index;
        this.update_controls();
        let snapshot;
        try {
            snapshot = await this.fetch(frame.name);
        } catch (fault) {
            this.pause();
            this.tell(`Snapshot ${frame.name}: ${fault.message}`);
            return;
        }
        if (!snapshot || this.at !== index) return;
        this.snapshot = snapshot;
        this.times.set(frame.name, snapshot.time); // the list has it from the file's name, if at all
        frame.time = snapshot.time;
        this.update_controls();
        if (!this.view.box) await this.find_box();
        this.paint();
    }

    // ---- playing

    play() {
        if (this.frames.length < 2) return;
        if (this.at >= this.frames.length - 1) this.at = -1;
        this.playing = true;
        this.update_controls();
        this.tick();
    }

    async tick() {
        const began = performance.now();
        await this.seek(this.at + 1);
        if (!this.playing) return;
        for (const frame of this.frames.slice(this.at + 1, this.at + 1 + ahead)) this.fetch(frame.name).catch(() => {}); // seek tells
        if (this.at >= this.frames.length - 1) {
            this.pause();
            return;
        }
        const rest = 1000 / frames_per_second - (performance.now() - began);
        this.timer = setTimeout(() => this.tick(), Math.max(rest, 0));
    }

    pause() {
        clearTimeout(this.timer);
        this.playing = false;
        this.update_controls();
    }

    // ---- what is seen around the canvas

    tell(text) {
        set_text(by_id("view-message"), text);
    }

    paint() {
        if (!this.snapshot || this.at < 0) return;
        const fields = Object.keys(this.snapshot.columns).filter((field) => field !== "x" && field !== "y");
        mirror(by_id("view-field"), fields, (field) => field, (field) => element("option", { value: field }),
               (option, field) => set_text(option, field_name(field)));
        if (!fields.includes(this.field)) this.field = fields.includes("epsilon_q") ? "epsilon_q" : fields[0];
        by_id("view-field").value = this.field;
        const field = this.field;
        const named = categories.includes(field);
        by_id("view-scale").hidden = named;
        by_id("view-regions").hidden = !named;
        const colour = named ? { field, named } : { field, ...this.scale_of(field) };
        if (named) this.draw_names(field === "region" ? this.snapshot.regions : this.snapshot.materials);
        else this.draw_scale(field, colour);
        this.view.show(this.snapshot, colour, this.spacing ?? 1);
        const what = this.snapshot.quads ? `${this.snapshot.quads.length / 4} elements` : `${this.snapshot.count} points`;
        set_text(by_id("view-count"), what);
        by_id("view").setAttribute("aria-label",
            `Soil at ${seconds(this.snapshot.time)}, ${what}, coloured by ${field_name(field)}. ` +
            "Arrow keys move, plus and minus zoom, zero shows all.");
    }

    scale_of(field) {
        const auto = by_id("view-auto").checked;
        const [low_input, high_input] = [by_id("view-low"), by_id("view-high")];
        low_input.disabled = auto;
        high_input.disabled = auto;
        if (auto) {
            const [low, high] = this.reaches[field] ?? [0, 1];
            low_input.value = number(low, 2);
            high_input.value = number(high > low ? high : 1, 2);
        }
        const low = Number(low_input.value);
        const high = Number(high_input.value);
        return high > low ? { low, high } : { low, high: low + 1 };
    }

    draw_scale(field, { low, high }) {
        by_id("view-ramp").style.background = scale_gradient;
        const unit = known_fields[field]?.unit ?? "";
        set_text(by_id("view-range"), `${field_name(field)}${unit ? ` [${unit}]` : ""}, ${number(low)} to ${number(high)}`);
    }

    draw_names(names) {
        // A region and a material may share their name and not their colour: the place in the list is the key.
        mirror(by_id("view-regions"), names.map((name, i) => ({ name, i })), ({ name, i }) => `${i}/${name}`,
               ({ name, i }) => element("li", {}, element("span", { class: "chip", style: `background: ${region_css(i)}` }), ` ${name}`),
               () => {});
    }

    update_controls() {
        const slider = by_id("view-time");
        const last = Math.max(this.frames.length - 1, 0);
        const frame = this.frames[this.at];
        slider.max = last;
        slider.value = Math.max(this.at, 0);
        slider.disabled = last === 0;
        slider.setAttribute("aria-valuetext", frame ? seconds(frame.time) : "no snapshot");
        set_text(by_id("view-now"), frame ? `t = ${seconds(frame.time)}  (${this.at + 1} of ${this.frames.length})` : "–");
        const play = by_id("view-play");
        play.disabled = last === 0;
        set_text(play, this.playing ? "❚❚ Pause" : "▶ Play");
    }
}

/// "final.vtkhdf" has no time in its name, so it is listed with 0.
function last_state_last(frames) {
    const timed = (frame) => /\d/.test(frame.name);
    return [...frames.filter(timed), ...frames.filter((frame) => !timed(frame))];
}

/// Which material each point is of, from its region: a colour of its own where regions share materials.
function add_material(snapshot, materials_of_regions) {
    const of_region = snapshot.regions.map((name, i) => snapshot.region_materials?.[i] ?? materials_of_regions.get(name) ?? "unknown");
    const names = [...new Set(of_region)];
    if (names.length === 0 || !snapshot.columns.region) return;
    const index = Float32Array.from(of_region, (name) => names.indexOf(name));
    snapshot.columns.material = snapshot.columns.region.map((region) => index[region]);
    snapshot.materials = names;
}

function source_name(task) {
    const what = task.phase === "fem_solver" ? ["FEM mesh", task.variant].filter(Boolean).join(", ") : mpm_name(task);
    return ["succeeded", "cached"].includes(task.state) ? what : `${what} (${task.state})`;
}

/// The last finished runout says most; before there is one, whatever runs.
function first_with_frames(tasks) {
    return tasks.findLast((task) => task.phase === "mpm_solver" && !is_active(task.state) && task.state !== "skipped") ??
           tasks.find((task) => task.phase === "mpm_solver" && task.state === "running") ??
           tasks.find((task) => task.phase === "fem_solver");
}
