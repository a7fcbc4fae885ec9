// The snapshots of one task: lists them, fetches and caches them, and finds the range of each field over all of them.
import * as api from "./api.js";
import { numbers_of, prepared, reach_of } from "./fields.js";

const kept_bytes = 192e6;       // snapshots kept in memory
const easy_count = 250000;      // more points are thinned at first
const most_surveyed = 60;       // snapshots read for the ranges of fields
const surveyed_points = 2000;   // of each

export class Snapshots {
    /// materials: region -> material, for servers that do not report it.
    constructor(task, materials = new Map()) {
        Object.assign(this, { task, materials, frames: [], stride: 1, is_thinned: false });
        this.kept = new Map();    // "name/stride" -> {snapshot, bytes}, oldest first
        this.coming = new Map();  // the same -> pending request
        this.times = new Map();   // name -> time in the file
        this.reaches = new Map(); // name -> {field: [low, high]}
        this.abort = new AbortController();
    }

    /// Aborts all pending requests.
    close() {
        this.abort.abort();
    }

    /// Updates the list; true: there are more snapshots.
    async list() {
        const frames = last_state_last(await api.list_frames(this.task));
        for (const frame of frames) frame.time = this.times.get(frame.name) ?? frame.time;
        const grew = frames.length !== this.frames.length;
        this.frames = frames;
        return grew;
    }

    /// The snapshot; null: aborted.
    async fetch(name) {
        const key = `${name}/${this.stride}`;
        const entry = this.kept.get(key);
        if (entry) {
            this.kept.delete(key); // mark as recently used
            this.kept.set(key, entry);
            return entry.snapshot;
        }
        if (!this.coming.has(key)) {
            const coming = this.get(name, key).finally(() => this.coming.delete(key));
            this.coming.set(key, coming);
        }
        return this.coming.get(key);
    }

    async get(name, key) {
        const snapshot = await this.read(name, this.stride);
        if (!snapshot) return null;
        if (snapshot.count > easy_count && this.kept.size === 0 && this.stride === 1) {
            this.stride = 4;
            return this.fetch(name);
        }
        this.keep(key, snapshot);
        this.times.set(name, snapshot.time); // the list has it from the file's name, if at all
        for (const frame of this.frames) if (frame.name === name) frame.time = snapshot.time;
        return snapshot;
    }

    async read(name, stride) {
        try {
            const snapshot = prepared(await api.read_points(this.task, name, stride, this.abort.signal), this.materials);
            this.learn(name, snapshot);
            return snapshot;
        } catch (fault) {
            if (fault.name === "AbortError") return null;
            throw fault;
        }
    }

    keep(key, snapshot) {
        this.kept.set(key, { snapshot, bytes: 4 * snapshot.count * Object.keys(snapshot.columns).length });
        let total = [...this.kept.values()].reduce((sum, entry) => sum + entry.bytes, 0);
        for (const [oldest, entry] of this.kept) {
            if (total <= kept_bytes || this.kept.size <= 2) break;
            this.kept.delete(oldest);
            total -= entry.bytes;
        }
    }

    learn(name, snapshot) {
        if (this.reaches.has(name)) return;
        this.reaches.set(name, Object.fromEntries(numbers_of(snapshot).map((field) => [field, reach_of(snapshot.columns[field])])));
    }

    /// [low, high] of a field over the surveyed snapshots.
    reach(field) {
        let [low, high] = [0, 0];
        for (const reaches of this.reaches.values()) {
            low = Math.min(low, reaches[field]?.[0] ?? 0);
            high = Math.max(high, reaches[field]?.[1] ?? 0);
        }
        return [low, high];
    }

    /// The snapshots behind reach(), in words.
    reach_text() {
        const [seen, all] = [this.reaches.size, this.frames.length];
        return seen >= all ? `all ${all} snapshots` : `${seen} of ${all} snapshots`;
    }

    /// Reads a few points of each snapshot, so that scales are fixed during playback; evenly spaced ones if there are many. told(): called
    /// after each change of a range.
    async survey(told) {
        if (this.surveying) return;
        this.surveying = true;
        try {
            const step = Math.max(1, this.frames.length / most_surveyed);
            for (let at = 0; at < this.frames.length && !this.abort.signal.aborted; at += step) {
                const { name } = this.frames[Math.floor(at)];
                if (this.reaches.has(name)) continue;
                const count = [...this.kept.values()].at(-1)?.snapshot.count ?? surveyed_points;
                await this.read(name, this.stride * Math.max(1, Math.floor(count / surveyed_points)));
                told();
            }
        } catch {
            // The picture reports an unreadable snapshot; its range stays unknown, as the legend says.
        } finally {
            this.surveying = false;
        }
    }

    /// Index of the newest snapshot not later than t, or of the first; -1: none.
    at_time(t) {
        let found = Math.min(0, this.frames.length - 1);
        this.frames.forEach((frame, i) => {
            if (frame.time <= t + 1e-9) found = i;
        });
        return found;
    }
}

/// "final.vtkhdf" has no time in its name and is listed with 0.
function last_state_last(frames) {
    const timed = (frame) => /\d/.test(frame.name);
    return [...frames.filter(timed), ...frames.filter((frame) => !timed(frame))];
}
