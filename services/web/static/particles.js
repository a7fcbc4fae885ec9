// The animation of a run: task, snapshot and coloured field. snapshots.js fetches the snapshots, points.js draws.
import { AnimationFiles } from "./animation_files.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { field_name, fields_of, is_named } from "./fields.js";
import { pace_text } from "./film.js";
import { picture_verdict } from "./flags.js";
import { by_point, is_active, mpm_name, number, seconds, variants_of } from "./format.js";
import { Gauges } from "./gauges.js";
import { longest_of } from "./overlay.js";
import { extents_of, PointView, spacing_of } from "./points.js";
import { Profile } from "./profile.js";
import { Scale } from "./scale.js";
import { materials_in, overlay_of, scene_of, water_of } from "./scene.js";
import { sheet_of } from "./sheet.js";
import { Snapshots } from "./snapshots.js";

const frames_per_second = 12;
const ahead = 2;                // snapshots fetched ahead while playing

export class Particles {
    /// row_of(task): the task's row of results, if known.
    constructor(row_of) {
        this.row_of = row_of;
        this.view = new PointView(by_id("view"));
        this.scale = new Scale("view", () => this.paint());
        this.profile = new Profile(this.view);
        this.gauges = new Gauges();
        this.files = new AnimationFiles("view", {
            count: () => this.frames.length, at: () => this.at, show: (i) => this.seek(i), sheet: (film) => this.sheet(film),
            name: () => `${this.run.name}_${this.field}_${this.snapshot.time}s`,
        });
        this.source = null; // Snapshots of the shown task
        this.at = -1;
        by_id("view-source").addEventListener("change", (event) => this.choose(event.target.value));
        by_id("view-field").addEventListener("change", (event) => {
            this.field = event.target.value;
            this.paint();
        });
        by_id("view-stride").addEventListener("change", () => this.reload());
        by_id("view-time").addEventListener("input", (event) => {
            this.by_hand = true;
            this.seek(Number(event.target.value));
        });
        by_id("view-play").addEventListener("click", () => {
            this.by_hand = true;
            (this.playing ? this.pause() : this.play());
        });
        by_id("view-in").addEventListener("click", () => this.view.zoom(1.25));
        by_id("view-out").addEventListener("click", () => this.view.zoom(0.8));
        by_id("view-fit").addEventListener("click", () => this.view.fit());
        for (const id of ["view-shading", "view-water", "view-vectors"]) by_id(id).addEventListener("change", () => this.paint());
    }

    get task() {
        return this.source?.task ?? null;
    }

    get frames() {
        return this.source?.frames ?? [];
    }

    /// Another run, or an update of the same one. governing: the first task to show, if known.
    async show(run, governing) {
        const same = this.run?.id === run.id;
        this.run = run;
        if (!same) this.close();
        const sources = picture_tasks(run);
        mirror(by_id("view-source"), sources, (task) => task.id,
               (task) => element("option", { value: task.id }), (option, task) => set_text(option, source_name(task)));
        by_id("particles").hidden = sources.length === 0;
        const current = sources.find((task) => task.id === this.task);
        // Until the user chooses or plays, show the governing variant, or before it exists a running one.
        const chosen = (this.by_hand && current) || (sources.find((task) => task.id === governing) ?? first_with_frames(sources));
        if (!chosen) return;
        const news = is_active(chosen.state) || this.frames.length === 0 || this.was_active;
        if (chosen.id !== this.task) await this.open(chosen.id);
        else if (news) await Promise.all([this.extend(), this.show_gauges()]);
        this.was_active = is_active(chosen.state);
    }

    /// Shows the particles of a point of the sweep.
    show_point(row) {
        if (row.mpm_task) this.choose(row.mpm_task);
    }

    choose(task) {
        this.by_hand = true;
        return this.open(task);
    }

    close() {
        this.by_hand = false;
        this.forget();
        this.tell("");
    }

    forget() {
        this.pause();
        this.files.stop();
        this.source?.close();
        this.source = null;
        this.at = -1; // the requested picture; `snapshot` is the shown one
        this.snapshot = null;
        this.shown = -1;
        this.box_frames = "";
        this.view.snapshot = null;
        this.view.box = null;
        this.view.fitted = true;
        this.view.redraw();
        this.update_controls();
    }

    async open(task) {
        this.forget();
        this.tell("Loading…");
        this.scene = scene_of(this.run.study, this.run.tasks.find(({ id }) => id === task)?.variant);
        this.view.overlay = { ...this.view.overlay, ...overlay_of(this.scene) };
        by_id("view-water-label").hidden = !water_of(this.scene);
        this.source = new Snapshots(task, materials_in(this.scene));
        this.source.stride = this.stride();
        by_id("view-source").value = task;
        by_id("view-compare").href = `#/compare/${encodeURIComponent(task)}`;
        await Promise.all([this.extend(), this.show_gauges()]);
    }

    show_gauges() {
        return this.gauges.show(this.run, this.run.tasks.find(({ id }) => id === this.task), this.scene);
    }

    async reload() {
        this.source.stride = this.stride();
        await this.seek(this.at);
    }

    /// Looks for new snapshots; moves to the newest one if the last was shown.
    async extend() {
        const source = this.source;
        const at_end = this.at === this.frames.length - 1;
        const grew = await source.list();
        if (source !== this.source) return;
        if (this.frames.length === 0) {
            this.tell("No snapshots yet.");
            this.update_controls();
            return;
        }
        if (grew) await this.find_box();
        if (this.at < 0 || (at_end && grew && !this.playing)) await this.seek(this.frames.length - 1);
        else this.update_controls();
        if (grew) source.survey(() => source === this.source && this.paint()); // continues in the background
    }

    /// A fixed box for all pictures: the soil at its begin and its end.
    async find_box() {
        const source = this.source;
        const ends = [this.frames[0].name, this.frames.at(-1).name];
        if (ends.join() === this.box_frames) return;
        const snapshots = [];
        for (const name of new Set(ends)) snapshots.push(await source.fetch(name));
        if (source !== this.source || snapshots.some((snapshot) => !snapshot)) return;
        this.box_frames = ends.join();
        const box = extents_of(snapshots);
        if (!box) return;
        size_canvas(by_id("view"), box);
        this.view.set_box(box);
        this.spacing = spacing_of(snapshots[0]);
    }

    stride() {
        return Number(by_id("view-stride").value);
    }

    async seek(index) {
        const source = this.source;
        const frame = this.frames[index];
        if (!frame) return;
        this.at = index;
        this.update_controls();
        let snapshot;
        try {
            snapshot = await source.fetch(frame.name);
        } catch (fault) {
            this.pause();
            this.tell(`Snapshot ${frame.name}: ${fault.message}`);
            return;
        }
        const overtaken = () => source !== this.source || this.at !== index;
        if (!snapshot || overtaken()) return;
        if (!this.view.box) await this.find_box();
        if (overtaken()) return;
        by_id("view-stride").value = source.stride;
        this.tell("");
        this.snapshot = snapshot;
        this.shown = index;
        this.update_controls();
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
        for (const frame of this.frames.slice(this.at + 1, this.at + 1 + ahead)) this.source.fetch(frame.name).catch(() => {}); // seek reports errors
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

    // ---- around the canvas

    tell(text) {
        set_text(by_id("view-message"), text);
    }

    paint() {
        const { snapshot } = this;
        if (!snapshot || this.at < 0) return;
        const fields = fields_of(snapshot);
        mirror(by_id("view-field"), fields, (field) => field, (field) => element("option", { value: field }),
               (option, field) => set_text(option, field_name(field)));
        if (!fields.includes(this.field)) this.field = fields.includes("epsilon_q") ? "epsilon_q" : fields[0];
        by_id("view-field").value = this.field;
        const is_mesh = Boolean(snapshot.quads);
        const contours = is_mesh && !is_named(this.field) && by_id("view-shading").value === "contours";
        by_id("view-shading-label").hidden = !is_mesh || is_named(this.field);
        by_id("view-vectors-label").hidden = !snapshot.columns.u_x;
        this.view.overlay.water = by_id("view-water").checked ? water_of(this.scene) : null;
        this.view.overlay.vectors = by_id("view-vectors").checked;
        this.view.show(snapshot, this.scale.of(this.field, [snapshot], [this.source], { contours }), this.spacing ?? 1);
        this.gauges.mark(snapshot.time);
        by_id("view-verdict").hidden = this.verdict() === "";
        set_text(by_id("view-verdict"), this.verdict());
        this.tell_vectors(snapshot);
        const what = is_mesh ? `${snapshot.quads.length / 4} elements` : `${snapshot.count} points`;
        set_text(by_id("view-count"), what);
        by_id("view").setAttribute("aria-label",
            `Soil at ${seconds(snapshot.time)}, ${what}, coloured by ${field_name(this.field)}. ` +
            "Arrow keys move, plus and minus zoom, zero shows all.");
        this.profile.show(snapshot, this.field, this.spacing ?? 1, `${this.run.title || this.run.name}, ${by_id("view-source").selectedOptions[0]?.textContent}`);
    }

    tell_vectors({ columns }) {
        const longest = columns.u_x && by_id("view-vectors").checked ? longest_of(this.snapshot) : null;
        set_text(by_id("view-vectors-note"), longest === null ? "" : longest > 0 ? `Longest vector ${number(longest, 3)} m, the others to its scale.`
            : "Nothing has moved: no vectors.");
    }

    verdict() {
        const task = this.run.tasks.find(({ id }) => id === this.task);
        return task ? picture_verdict(task, this.row_of(task.id)) : "";
    }

    /// The picture with all notes as a sheet, for a file.
    sheet(film) {
        if (!this.snapshot) return null;
        this.view.paint();
        const { colour, names, grey, notes } = this.scale.shown;
        const caption = `${by_id("view-source").selectedOptions[0]?.textContent}, t = ${this.snapshot.time.toFixed(2)} s`;
        const more = [by_id("view-vectors-note").textContent, this.view.overlay.water ? "Blue: phreatic line of the scene, before anything moves." : "",
                      this.snapshot.quads ? "" : `${this.snapshot.count} points.`];
        return sheet_of({ title: this.run.title || this.run.name, parts: [{ view: this.view, caption }], colour, names, grey,
                          notes: [this.verdict(), ...notes, more.filter(Boolean).join(" "), film ? pace_text(this.frames.map(({ time }) => time)) : "",
                                  `Run ${this.run.id}, Breachline.`] });
    }

    update_controls() {
        const slider = by_id("view-time");
        const last = Math.max(this.frames.length - 1, 0);
        const frame = this.frames[this.at];
        slider.max = last;
        slider.value = Math.max(this.at, 0);
        slider.disabled = last === 0;
        slider.setAttribute("aria-valuetext", frame ? seconds(frame.time) : "no snapshot");
        set_text(by_id("view-now"), this.now_text());
        const play = by_id("view-play");
        play.disabled = last === 0;
        set_text(play, this.playing ? "❚❚ Pause" : "▶ Play");
    }

    /// The time of the shown picture; the requested one may still be loading.
    now_text() {
        if (!this.frames[this.at]) return "–";
        const coming = `number ${this.at + 1} is on its way`;
        if (!this.snapshot) return coming;
        const seen = `t = ${seconds(this.snapshot.time)}  (${this.shown + 1} of ${this.frames.length})`;
        return this.shown === this.at || this.playing ? seen : `${seen}, ${coming}`;
    }
}

export function size_canvas(canvas, box) {
    const slenderness = (box.y[1] - box.y[0]) / Math.max(box.x[1] - box.x[0], 1e-9);
    canvas.style.setProperty("--slenderness", Math.min(0.75, Math.max(0.2, slenderness * 1.04)));
}

export function picture_tasks(run) {
    return run.tasks.filter((task) => task.phase === "fem_solver" || task.phase === "mpm_solver").sort(by_point(variants_of(run)));
}

export function source_name(task) {
    const what = task.phase === "fem_solver" ? ["FEM mesh", task.variant].filter(Boolean).join(", ") : mpm_name(task);
    return ["succeeded", "cached"].includes(task.state) ? what : `${what} (${task.state})`;
}

/// The last finished runout; before there is one, a running one.
export function first_with_frames(tasks) {
    return tasks.findLast((task) => task.phase === "mpm_solver" && !is_active(task.state) && task.state !== "skipped") ??
           tasks.find((task) => task.phase === "mpm_solver" && task.state === "running") ??
           tasks.find((task) => task.phase === "fem_solver");
}
