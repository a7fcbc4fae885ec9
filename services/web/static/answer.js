// The head of a run: its verdict, the section before and after, factor of safety, runout, depth, arrivals, and the governing variant, all
// from the service's findings.
import * as api from "./api.js";
import { by_id, element, mirror, set_text } from "./dom.js";
import { reason_items, verdict_look } from "./flags.js";
import { number, point_name, seconds } from "./format.js";
import { draws_of } from "./means.js";
import { overlay_of, scene_of, water_of } from "./scene.js";
import { profile_in, SectionPicture, slip_surface } from "./section_picture.js";

/// The governing row, as the service chose it, and the mean of its repeats; null: none.
export function governing_of(run, rows, means) {
    const row = rows.find((each) => each.mpm_task && each.mpm_task === run.governing?.task) ?? null;
    return { row, mean: means.find((mean) => draws_of(mean, rows, run.study).includes(row)) ?? null };
}

export class Answer {
    /// look_at(row): called to show the governing variant.
    constructor(look_at) {
        this.look_at = look_at;
        this.picture = new SectionPicture(by_id("answer-picture"));
        this.profiles = new Map(); // SHA-256 -> profile
    }

    /// Shows what the list knows of a run before the rest arrives.
    begin(run) {
        Object.assign(this, { run, rows: [], row: run.governing, mean: null, quantiles: null, profile: null, task: null });
        by_id("answer-picture").hidden = true;
        this.show_verdict(run);
        this.draw_figures();
    }

    show_verdict({ headline, verdict, flag_counts: flags }) {
        set_text(by_id("headline"), headline.text);
        by_id("headline").hidden = headline.text === "";
        const look = verdict_look(verdict.usable);
        by_id("verdict").className = `verdict ${look}${verdict.usable === "no" ? " unusable" : ""}`;
        set_text(by_id("verdict"), `${look === "bad" ? "✕ " : ""}Verdict: ${verdict.words}`);
        mirror(by_id("reasons"), reason_items(verdict, flags), ({ key }) => key, ({ make }) => make(), () => {});
    }

    /// Resolves when it is drawn; the deposit follows. governing: from governing_of; quantiles: {p10, p50, p90} of the runout of a study
    /// over distributions, or null.
    async show(run, rows, governing, quantiles) {
        Object.assign(this, { run, rows, quantiles }, governing);
        this.show_verdict(run);
        by_id("answer-picture").hidden = false;
        const { row } = governing;
        this.scene = scene_of(run.study, row?.variant ?? run.study?.variants?.[0]?.name);
        this.task = run.tasks.find(({ id }) => id === row?.mpm_task && Number.isFinite(row?.runout));
        const file = this.task?.artifacts.find(({ name }) => name === "profile.csv");
        this.profile = this.profiles.get(file?.sha256) ?? null;
        this.draw();
        if (file && !this.profile) this.read_profile(file.sha256, row).catch((fault) => console.warn("profile:", fault));
    }

    async read_profile(sha256, row) {
        const profile = profile_in(await api.read_text_artifact(sha256));
        this.profiles.set(sha256, profile);
        if (this.row?.mpm_task !== row.mpm_task) return;
        this.profile = profile;
        this.draw();
    }

    draw_figures() {
        mirror(by_id("answer-figures"), this.figures(), ({ name }) => name, () => element("div", {}, element("dt"), element("dd"), element("dd", { class: "muted" })),
               (entry, { name, value, note, title, look_at }) => {
                   const [term, own, more] = entry.children;
                   set_text(term, name);
                   if (!look_at) set_text(own, value);
                   else if (own.textContent !== value) own.replaceChildren(element("button", { type: "button", class: "link", onclick: () => this.look_at(this.row) }, value));
                   set_text(more, note ?? "");
                   more.title = title ?? "";
               });
    }

    draw() {
        this.draw_figures();
        const stability = this.run.tasks.find(({ id }) => id === this.run.stability?.task)?.result; // of the headline's factor
        const { toe, outlines, gauges } = overlay_of(this.scene);
        const runout = this.runout();
        const after_name = ["after", this.rows.length > 1 && this.row ? point_name(this.row) : ""].filter(Boolean).join(", ");
        const picture = { outlines, after_name, toe, gauges, water: water_of(this.scene), runout, slip: slip_surface(stability, this.scene.lem?.floor), slip_name: `slip surface, FS ${number(stability?.factor_of_safety, 3)}`,
                          after: this.profile && [...this.profile.map(({ x, surface }) => [x, surface]), ...this.profile.map(({ x, ground }) => [x, ground]).reverse()] };
        this.picture.show({ ...picture, says: `The section before${this.profile ? " and after" : ""}. ` +
            this.figures().map(({ name, value }) => `${name}: ${value}.`).join(" ") });
    }

    /// {reach, low, high [m], text, band: meaning of the band}; null: none.
    runout() {
        const { row, mean, quantiles } = this;
        const reach = quantiles?.p50 ?? mean?.runout ?? row?.runout;
        if (!Number.isFinite(reach)) return null;
        if (quantiles) return { reach, low: quantiles.p10, high: quantiles.p90, band: "p10 to p90", text: `${number(reach, 3)} m, p10 to p90 ${number(quantiles.p10, 3)} to ${number(quantiles.p90, 3)} m` };
        const error = (mean ?? row).runout_error;
        const known = Number.isFinite(error);
        return { reach, low: known ? reach - error : null, high: known ? reach + error : null, band: "error",
                 text: `${row?.lower_bound ? "≥ " : ""}${number(reach, 3)}${known ? ` ± ${number(error, 2)}` : ""} m` };
    }

    /// [{name, value, note, title}] in reading order.
    figures() {
        const { row, mean, rows, quantiles, run: { stability } } = this;
        const found = [];
        if (stability) {
            const { factor_of_safety: factor, factor_of_safety_liquefied: liquefied, variant } = stability;
            found.push({ name: "Factor of safety", value: number(factor, 3),
                         note: [Number.isFinite(liquefied) ? `${number(liquefied, 3)} liquefied` : "", variant].filter(Boolean).join(", ") });
        }
        const runout = this.runout();
        if (runout) {
            const from = (mean ?? row).runout_error_from;
            found.push({ name: "Runout", value: runout.text, title: from,
                         note: quantiles ? "median over the samples" : [runout.reach < 0 ? "99 % of the soil stays behind the toe" : "", row.lower_bound ? "still moving" : "", runout.low === null ? "numerical error not quantified" : from].filter(Boolean).join("; ") });
        }
        if (Number.isFinite(row?.depth_beyond_toe)) found.push({ name: "Depth beyond the toe", value: `${number(row.depth_beyond_toe, 2)} m`, note: "deepest, at the end" });
        for (const [name, gauge] of Object.entries(this.task?.result?.gauges ?? {})) found.push(arrival_of(name, gauge));
        const others = rows.filter(({ runout: each }) => Number.isFinite(each));
        if (row && rows.length > 1) {
            const least = Math.min(...others.map(({ runout: each }) => each));
            found.push({ name: "Governing variant", value: point_name(row), look_at: true,
                         note: others.length ? `largest of ${others.length} runouts, from ${number(least, 3)} m` : `least factor of safety of ${rows.length}` });
        }
        return found;
    }
}

const arrival_of = (name, { x, arrival_time: arrival, largest_depth: depth, largest_velocity: velocity }) => ({
    name: `Arrival at ${name}`, value: Number.isFinite(arrival) ? seconds(Number(arrival.toPrecision(3))) : "never",
    note: `x = ${number(x)} m${Number.isFinite(arrival) ? `, ${number(depth, 2)} m deep, ${number(velocity, 2)} m/s` : ""}` });
