// Two pictures side by side at one time: same box, same colours, one slider. For any two tasks with snapshots.
import * as api from "./api.js";
import { AnimationFiles } from "./animation_files.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { field_name, fields_of, is_named } from "./fields.js";
import { pace_text } from "./film.js";
import { picture_verdict, rest_text } from "./flags.js";
import { is_active, number, seconds } from "./format.js";
import { first_with_frames, picture_tasks, size_canvas, source_name } from "./particles.js";
import { extents_of, PointView, spacing_of } from "./points.js";
import { Scale } from "./scale.js";
import { offer_runs } from "./run_picker.js";
import { materials_in, overlay_of, scene_of, water_of } from "./scene.js";
import { sheet_of } from "./sheet.js";
import { Snapshots } from "./snapshots.js";

const frames_per_second = 12;
const same_time = 1e-6; // [s]

export const compare_address = (...tasks) => `#/compare/${tasks.filter(Boolean).map(encodeURIComponent).join("/")}`;

/// One of the two pictures.
class Side {
    constructor(index) {
        this.index = index;
        this.view = new PointView(by_id(`compare-${index}`));
        this.source = null;
    }

    /// Opens another task, or refreshes the same one.
    async open(task) {
        if (this.source?.task === task && !is_active(this.task.state)) return;
        const { run } = await api.read_task(task);
        this.run = await api.read_run(run);
        this.task = this.run.tasks.find(({ id }) => id === task);
        const scene = scene_of(this.run.study, this.task?.variant);
        if (this.source?.task !== task) {
            this.source?.close();
            this.source = new Snapshots(task, materials_in(scene));
            this.snapshot = null;
        }
        this.view.overlay = { ...overlay_of(scene), water: water_of(scene) };
        this.row = this.task.phase === "mpm_solver" ? (await api.read_results(run)).rows.find((row) => row.mpm_task === task) : null;
        await this.source.list();
    }

    async seek(time) {
        const at = this.source.at_time(time);
        if (at < 0) return;
        const frame = this.wanted_frame = this.source.frames[at];
        const snapshot = await this.source.fetch(frame.name);
        if (!snapshot || this.wanted_frame !== frame) return; // a later one may have arrived
        this.snapshot = snapshot;
        this.is_last = at === this.source.frames.length - 1;
    }

    /// Notes on this picture: the origin of its time, its age, and whether more will come.
    says(time) {
        if (!this.snapshot) return "No snapshot yet.";
        const clock_name = this.task.phase === "fem_solver" ? "since the first dynamic stage began"
            : Number.isFinite(this.task.transfer_time) ? `since its transfer at t_T = ${number(this.task.transfer_time)} s` : "since it began";
        const over = this.is_last && time > this.snapshot.time + same_time ? "; its last snapshot, it goes no further" : "";
        const rest = this.row ? `; at its end: ${rest_text(this.row)}` : "";
        return `${seconds(this.snapshot.time)} ${clock_name}${over}${rest}`;
    }
}

export class Compare {
    constructor() {
        this.sides = [new Side(0), new Side(1)];
        this.scale = new Scale("compare", () => this.paint());
        const [a, b] = this.sides.map(({ view }) => view);
        a.moved = (view) => b.follow(view);
        b.moved = (view) => a.follow(view);
        for (const index of [0, 1]) {
            by_id(`compare-run-${index}`).addEventListener("change", (event) => this.choose_run(index, event.target.value));
            by_id(`compare-source-${index}`).addEventListener("change", (event) => this.choose(index, event.target.value));
        }
        by_id("compare-field").addEventListener("change", () => this.paint());
        by_id("compare-time").addEventListener("input", (event) => this.seek(Number(event.target.value)));
        by_id("compare-play").addEventListener("click", () => (this.playing ? this.pause() : this.play()));
        by_id("compare-fit").addEventListener("click", () => this.sides.forEach(({ view }) => view.fit()));
        this.times = [];
        this.at = 0;
        this.files = new AnimationFiles("compare", {
            count: () => this.times.length, at: () => this.at, show: (i) => this.seek(i), sheet: (film) => this.sheet(film), name: () => "comparison",
        });
    }

    choose(index, task) {
        const tasks = this.sides.map(({ source }) => source?.task);
        tasks[index] = task;
        location.hash = compare_address(...tasks);
    }

    async choose_run(index, id) {
        const side = this.sides[index];
        side.wanted_run = id; // until its address is shown, offer no tasks of the previous run
        by_id(`compare-source-${index}`).disabled = true;
        let why = "That run leaves no snapshots; this is still the one before.";
        const run = await api.read_run(id).catch((fault) => { why = fault.message; });
        if (side.wanted_run !== id) return;
        const task = run && first_with_frames(picture_tasks(run));
        if (task) {
            this.choose(index, task.id);
            return;
        }
        side.wanted_run = null;
        by_id(`compare-source-${index}`).disabled = false;
        by_id(`compare-run-${index}`).value = side.run.id;
        set_text(by_id(`compare-says-${index}`), why);
    }

    /// Shows tasks by id; without a second one the user chooses it.
    async show(tasks) {
        const wanted = [tasks[0], tasks[1] ?? tasks[0]];
        const runs = await api.list_runs();
        for (const side of this.sides) await side.open(wanted[side.index]);
        if (wanted.some((task, i) => task !== this.sides[i].source?.task)) return;
        if (this.shown !== wanted.join()) for (const side of this.sides) side.wanted_run = null;
        for (const side of this.sides) if (!side.wanted_run) this.offer(side, runs);
        const times = this.sides.flatMap(({ source }) => source.frames.map(({ time }) => time)).sort((a, b) => a - b);
        const fresh = this.shown !== wanted.join() || times.length !== this.count;
        this.shown = wanted.join();
        this.count = times.length;
        if (!fresh) return;
        this.pause();
        this.files.stop();
        this.times = times.filter((time, i) => i === 0 || time - times[i - 1] > same_time);
        await this.find_box();
        await this.seek(this.times.length - 1);
        for (const { source } of this.sides) source.survey(() => source.task && this.paint());
    }

    offer({ index, run, source }, runs) {
        const known = runs.some(({ id }) => id === run.id) ? runs : [run, ...runs];
        offer_runs(by_id(`compare-run-${index}`), known, run.id);
        mirror(by_id(`compare-source-${index}`), picture_tasks(run), ({ id }) => id, ({ id }) => element("option", { value: id }),
               (option, task) => set_text(option, source_name(task)));
        by_id(`compare-source-${index}`).value = source.task;
        by_id(`compare-source-${index}`).disabled = false;
    }

    /// One box for both.
    async find_box() {
        const ends = [];
        for (const side of this.sides) {
            const { frames } = side.source;
            const own = [];
            for (const frame of new Set([frames[0], frames.at(-1)].filter(Boolean))) own.push(await side.source.fetch(frame.name));
            const read = own.filter(Boolean);
            if (read.length) side.spacing = spacing_of(read[0]);
            ends.push(...read);
        }
        const box = extents_of(ends);
        if (!box) return;
        for (const { view } of this.sides) {
            size_canvas(view.canvas, box);
            view.fitted = true;
            view.set_box(box);
        }
    }

    async seek(index) {
        this.at = index;
        const time = this.times[index];
        if (time === undefined) return;
        try {
            await Promise.all(this.sides.map((side) => side.seek(time)));
        } catch (fault) {
            this.pause();
            set_text(by_id("compare-note"), fault.message);
            return;
        }
        if (this.at === index) this.paint();
    }

    play() {
        if (this.times.length < 2) return;
        if (this.at >= this.times.length - 1) this.at = -1;
        this.playing = true;
        this.tick();
    }

    async tick() {
        const began = performance.now();
        await this.seek(this.at + 1);
        if (!this.playing) return;
        if (this.at >= this.times.length - 1) this.pause();
        else this.timer = setTimeout(() => this.tick(), Math.max(0, 1000 / frames_per_second - (performance.now() - began)));
    }

    pause() {
        clearTimeout(this.timer);
        this.playing = false;
        this.update_controls();
    }

    paint() {
        const shown = this.sides.filter(({ snapshot }) => snapshot);
        this.update_controls();
        for (const side of this.sides) set_text(by_id(`compare-says-${side.index}`), side.says(this.times[this.at]));
        if (shown.length === 0) return;
        const snapshots = shown.map(({ snapshot }) => snapshot);
        const fields = fields_of(snapshots[0]).filter((field) => snapshots.every(({ columns }) => columns[field]));
        const select = by_id("compare-field");
        const before = select.value;
        mirror(select, fields, (field) => field, (field) => element("option", { value: field }), (option, field) => set_text(option, field_name(field)));
        select.value = fields.includes(before) ? before : fields.includes("epsilon_q") ? "epsilon_q" : fields[0];
        const field = select.value;
        const contours = snapshots.every(({ quads }) => quads);
        const colour = this.scale.of(field, snapshots, shown.map(({ source }) => source), { contours });
        for (const { view, snapshot, spacing } of shown) view.show(snapshot, colour, spacing ?? 1);
        set_text(by_id("compare-note"), this.note(field, snapshots));
    }

    /// Reasons why the two are hard to compare.
    note(field, [a, b]) {
        if (!b) return "";
        const remarks = [];
        const [one, other] = this.sides.map(({ task }) => task.phase);
        if (one !== other) remarks.push("The two have different clocks: a mesh's time is since its first dynamic stage began, a runout's since its transfer.");
        const names = (snapshot) => (field === "region" ? snapshot.regions : snapshot.materials ?? []).join();
        if (is_named(field) && names(a) !== names(b)) remarks.push("Their names differ: the legend is the left one's.");
        return remarks.join(" ");
    }

    /// The pictures with all notes as a sheet, for a file.
    sheet(film) {
        if (this.sides.some(({ snapshot }) => !snapshot)) return null;
        const { colour, names, grey, notes } = this.scale.shown;
        const parts = this.sides.map((side) => {
            side.view.paint();
            return { view: side.view, caption: `${side.run.title || side.run.name}, ${source_name(side.task)}: ${side.says(this.times[this.at])}` };
        });
        const verdicts = this.sides.map(({ task, row, index }) => [["Left", "Right"][index], picture_verdict(task, row)]).filter(([, verdict]) => verdict);
        return sheet_of({ title: `t = ${this.times[this.at].toFixed(2)} s, each on its own clock`, parts, colour, names, grey,
                          notes: [...verdicts.map((each) => each.join(": ")), by_id("compare-note").textContent, ...notes,
                                  film ? pace_text(this.times) : "", `Runs ${this.sides.map(({ run }) => run.id).join(" and ")}, Breachline.`] });
    }

    update_controls() {
        const slider = by_id("compare-time");
        slider.max = Math.max(this.times.length - 1, 0);
        slider.value = Math.max(this.at, 0);
        slider.disabled = this.times.length < 2;
        const time = this.times[this.at];
        slider.setAttribute("aria-valuetext", seconds(time));
        set_text(by_id("compare-now"), `t = ${seconds(time)}`);
        by_id("compare-play").disabled = this.times.length < 2;
        set_text(by_id("compare-play"), this.playing ? "❚❚ Pause" : "▶ Play");
    }
}
