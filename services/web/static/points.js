// Draws one snapshot, particles or a mesh of quads, on a canvas: equal aspect, pan, zoom, axes in metres.
import { band_colours, mixed, packed, region_css, scale_packed, scale_steps, unknown_css } from "./colours.js";
import { fill_contours } from "./contours.js";
import { apart, draw_cut, draw_gauges, draw_outlines, draw_toe, draw_vectors, draw_water } from "./overlay.js";
import { tick_label, ticks } from "./plot_scale.js";
import { draw_edge, fill_quad, fill_square } from "./raster.js";

const unknown = packed(unknown_css);
const region_packed = Uint32Array.from({ length: 256 }, (_, i) => packed(region_css(i)));
const least_edge = 4; // [CSS px] shorter edges are not drawn

const edge = { left: 52, right: 10, top: 10, bottom: 34 }; // margins for the axes [CSS px]

/// {x: [low, high], y: [low, high]} of several snapshots; null without points.
export function extents_of(snapshots) {
    const box = { x: [Infinity, -Infinity], y: [Infinity, -Infinity] };
    for (const { columns } of snapshots) {
        for (const axis of ["x", "y"]) {
            for (const value of columns[axis]) {
                if (value < box[axis][0]) box[axis][0] = value;
                if (value > box[axis][1]) box[axis][1] = value;
            }
        }
    }
    return box.x[0] <= box.x[1] ? box : null;
}

/// Distance to the fourth-nearest point, upper tenth of a sample [m]: in a rectangular pattern the longer spacing, so that squares of this
/// size leave no gaps.
export function spacing_of({ columns: { x, y }, count }) {
    const sample = Math.min(60, count);
    const distances = [];
    for (let k = 0; k < sample; k += 1) {
        const i = Math.floor((k * count) / sample);
        const nearest = [Infinity, Infinity, Infinity, Infinity]; // squares, ascending
        for (let j = 0; j < count; j += 1) {
            const square = (x[j] - x[i]) ** 2 + (y[j] - y[i]) ** 2;
            if (j === i || square >= nearest[3]) continue;
            let place = 3;
            for (; place > 0 && nearest[place - 1] > square; place -= 1) nearest[place] = nearest[place - 1];
            nearest[place] = square;
        }
        if (Number.isFinite(nearest[3])) distances.push(Math.sqrt(nearest[3]));
    }
    distances.sort((a, b) => a - b);
    return distances.length ? distances[Math.floor(0.9 * (distances.length - 1))] : 1;
}

export class PointView {
    /// overlay, drawn over the soil: {outlines: [[[x, y], ...], ...], toe: [x, y] | null, gauges: [{name, x, y}], water: [[x, y], ...] |
    /// null, vectors: true | false, cut: [[x, y], [x, y]] | null}. moved(view): called after the user moved the picture. pick([x, y]):
    /// receives a click; null: none wanted.
    constructor(canvas) {
        this.canvas = canvas;
        this.context = canvas.getContext("2d", { alpha: false });
        this.snapshot = null;
        this.overlay = { outlines: [], toe: null };
        this.moved = () => {};
        this.pick = null;
        this.box = null;
        this.fitted = true;
        this.paint_time = 0; // [ms] of the last picture
        this.image = null; // the canvas's pixels, kept between pictures
        new ResizeObserver(() => this.resize()).observe(canvas);
        this.listen();
    }

    /// colour: {field, low, high, contours} for numbers (contours: nodal values of a mesh in bands, else one colour per element), or
    /// {field, named: true} for indices into a list of names.
    show(snapshot, colour, spacing) {
        this.snapshot = snapshot;
        this.colour = colour;
        this.spacing = spacing;
        this.redraw();
    }

    /// The box that fit() shows.
    set_box(box) {
        this.box = box;
        if (this.fitted) this.fit();
    }

    fit() {
        this.fitted = true;
        if (!this.box || !this.canvas.width) return;
        const { width, height } = this.plot_area();
        const span_x = Math.max(this.box.x[1] - this.box.x[0], 1e-6) * 1.04;
        const span_y = Math.max(this.box.y[1] - this.box.y[0], 1e-6) * 1.08;
        this.scale = Math.min(width / span_x, height / span_y);
        this.centre = [(this.box.x[0] + this.box.x[1]) / 2, (this.box.y[0] + this.box.y[1]) / 2];
        this.redraw();
    }

    zoom(factor, at = null) {
        if (!this.scale) return;
        const area = this.plot_area();
        const [px, py] = at ?? [area.left + area.width / 2, area.top + area.height / 2];
        const fixed = this.to_world(px, py);
        this.scale *= factor;
        const moved = this.to_world(px, py);
        this.centre = [this.centre[0] + fixed[0] - moved[0], this.centre[1] + fixed[1] - moved[1]];
        this.fitted = false;
        this.moved(this);
        this.redraw();
    }

    /// Shows what another view of the same size shows.
    follow({ scale, centre, fitted }) {
        Object.assign(this, { scale, centre, fitted });
        this.redraw();
    }

    /// dx, dy: movement in CSS pixels.
    pan(dx, dy) {
        if (!this.scale) return;
        this.centre = [this.centre[0] - (dx * this.ratio) / this.scale, this.centre[1] + (dy * this.ratio) / this.scale];
        this.fitted = false;
        this.moved(this);
        this.redraw();
    }

    // ---- geometry, all in device pixels

    plot_area() {
        const r = this.ratio;
        return { left: edge.left * r, top: edge.top * r, width: this.canvas.width - (edge.left + edge.right) * r,
                 height: this.canvas.height - (edge.top + edge.bottom) * r };
    }

    to_screen(x, y) {
        const area = this.plot_area();
        return [area.left + area.width / 2 + (x - this.centre[0]) * this.scale,
                area.top + area.height / 2 - (y - this.centre[1]) * this.scale];
    }

    to_world(px, py) {
        const area = this.plot_area();
        return [this.centre[0] + (px - area.left - area.width / 2) / this.scale,
                this.centre[1] - (py - area.top - area.height / 2) / this.scale];
    }

    resize() {
        const { width, height } = this.canvas.getBoundingClientRect();
        if (width < 10 || height < 10) return;
        this.ratio = Math.min(window.devicePixelRatio || 1, 2);
        this.canvas.width = Math.round(width * this.ratio);
        this.canvas.height = Math.round(height * this.ratio);
        if (this.fitted) this.fit();
        else this.redraw();
    }

    // ---- drawing

    redraw() {
        if (this.pending) return;
        this.pending = requestAnimationFrame(() => {
            this.pending = 0;
            this.paint();
        });
    }

    paint() {
        if (!this.canvas.width) return;
        const style = getComputedStyle(this.canvas);
        const began = performance.now();
        const ground = style.getPropertyValue("--canvas").trim();
        const { context, canvas } = this;
        context.fillStyle = ground;
        context.fillRect(0, 0, canvas.width, canvas.height);
        if (this.snapshot && this.scale) {
            this.paint_soil(ground, style.getPropertyValue("--mesh").trim());
            this.paint_overlay(style);
            this.paint_axes(style, ground);
        }
        this.paint_time = performance.now() - began;
    }

    /// Index into the colour scale, or into the names, for every point.
    shades() {
        const values = this.snapshot.columns[this.colour.field];
        const shades = new Int16Array(this.snapshot.count).fill(-1);
        if (!values) return shades;
        if (this.colour.named) return shades.map((_, i) => values[i]);
        const { low, high } = this.colour;
        const factor = (scale_steps - 1) / Math.max(high - low, 1e-30);
        for (let i = 0; i < shades.length; i += 1) {
            const value = values[i];
            if (value === value) shades[i] = Math.min(scale_steps - 1, Math.max(0, (value - low) * factor));
        }
        return shades;
    }

    paint_soil(ground, line) {
        const { width, height } = this.canvas;
        if (this.image?.width !== width || this.image?.height !== height) {
            this.data = this.context.createImageData(width, height);
            this.image = { pixels: new Uint32Array(this.data.data.buffer), width, height };
        }
        const { image } = this;
        image.pixels.fill(packed(ground));
        const shades = this.shades();
        const palette = this.colour.named ? region_packed : scale_packed;
        if (this.snapshot.quads && this.colour.contours) this.paint_contours(image, line);
        else if (this.snapshot.quads) this.paint_quads(image, shades, palette, line);
        else this.paint_squares(image, shades, palette);
        this.context.putImageData(this.data, 0, 0);
    }

    paint_squares(image, shades, palette) {
        const { x, y } = this.snapshot.columns;
        const size = Math.max(Math.ceil(this.spacing * this.scale), Math.ceil(1.5 * this.ratio));
        const [origin_x, origin_y] = this.to_screen(0, 0);
        for (let i = 0; i < shades.length; i += 1) {
            const left = Math.round(origin_x + x[i] * this.scale - size / 2);
            const top = Math.round(origin_y - y[i] * this.scale - size / 2);
            fill_square(image, left, top, size, shades[i] < 0 ? unknown : palette[shades[i] & 255]);
        }
    }

    /// Node positions [device pixels].
    nodes() {
        const { columns } = this.snapshot;
        const [origin_x, origin_y] = this.to_screen(0, 0);
        return { x: columns.x.map((value) => origin_x + value * this.scale), y: columns.y.map((value) => origin_y - value * this.scale) };
    }

    paint_contours(image, line) {
        const { quads, columns } = this.snapshot;
        const { field, low, high } = this.colour;
        const { x, y } = this.nodes();
        const share = columns[field].map((value) => (value - low) / Math.max(high - low, 1e-30));
        fill_contours(image, { x, y, share, quads, palette: band_colours, unknown });
        this.paint_edges(image, x, y, () => packed(line), 0.18);
    }

    /// Fills every element with the mean of its corners' shades, with edges mixed with the line's colour.
    paint_quads(image, shades, palette, line) {
        const { quads } = this.snapshot;
        const { x, y } = this.nodes();
        const edges = palette.map((colour) => mixed(colour, packed(line), 0.35));
        const unknown_edge = mixed(unknown, packed(line), 0.35);
        const colour_of = (q, colours, none) => {
            const shade = this.shade_of(quads.subarray(q, q + 4), shades);
            return shade < 0 ? none : colours[shade & 255];
        };
        for (let q = 0; q < quads.length; q += 4) fill_quad(image, x, y, quads.subarray(q, q + 4), colour_of(q, palette, unknown));
        this.paint_edges(image, x, y, (q) => colour_of(q, edges, unknown_edge));
    }

    /// Draws edges unless the elements are too small. share: opacity of the line's colour.
    paint_edges(image, x, y, colour_of, share = 1) {
        const { quads } = this.snapshot;
        if (this.mean_edge(x, y) <= least_edge * this.ratio) return;
        for (let q = 0; q < quads.length; q += 4) {
            const colour = colour_of(q);
            for (let k = 0; k < 4; k += 1) draw_edge(image, x, y, quads[q + k], quads[q + ((k + 1) & 3)], colour, share);
        }
    }

    /// Mean of the corners with a shade; -1: none.
    shade_of(corners, shades) {
        let [sum, known, least] = [0, 0, 256];
        for (const corner of corners) {
            if (shades[corner] < 0) continue;
            sum += shades[corner];
            known += 1;
            least = Math.min(least, shades[corner]);
        }
        if (known === 0) return -1;
        return this.colour.named ? least : Math.round(sum / known);
    }

    /// Mean edge length of a sample [device pixels].
    mean_edge(x, y) {
        const { quads } = this.snapshot;
        const step = 4 * Math.max(1, Math.floor(quads.length / 4 / 100));
        let [sum, count] = [0, 0];
        for (let q = 0; q < quads.length; q += step) {
            sum += Math.hypot(x[quads[q + 1]] - x[quads[q]], y[quads[q + 1]] - y[quads[q]]);
            sum += Math.hypot(x[quads[q + 2]] - x[quads[q + 1]], y[quads[q + 2]] - y[quads[q + 1]]);
            count += 2;
        }
        return sum / Math.max(count, 1);
    }

    paint_overlay(style) {
        const { context, ratio } = this;
        const { outlines, toe, gauges, water, vectors, cut } = this.overlay;
        const pen = { context, ratio, to_screen: (x, y) => this.to_screen(x, y) };
        const in_colour = (name) => {
            context.strokeStyle = context.fillStyle = style.getPropertyValue(name).trim();
        };
        const halo = style.getPropertyValue("--canvas").trim();
        in_colour("--text");
        draw_outlines(pen, outlines);
        if (toe) draw_toe(pen, toe);
        draw_gauges(pen, gauges ?? []);
        if (vectors && this.snapshot.columns.u_x) draw_vectors(pen, this.snapshot, halo);
        in_colour("--water");
        if (water) draw_water(pen, water, halo);
        in_colour("--fired");
        if (cut) draw_cut(pen, cut);
    }

    paint_axes(style, ground) {
        const { context, canvas, ratio } = this;
        const area = this.plot_area();
        const bottom = area.top + area.height;
        const right = area.left + area.width;
        context.fillStyle = ground; // clears the margins
        context.fillRect(0, 0, area.left, canvas.height);
        context.fillRect(right, 0, canvas.width - right, canvas.height);
        context.fillRect(0, 0, canvas.width, area.top);
        context.fillRect(0, bottom, canvas.width, canvas.height - bottom);
        const [x_low, y_low] = this.to_world(area.left, bottom);
        const [x_high, y_high] = this.to_world(right, area.top);
        context.strokeStyle = style.getPropertyValue("--axis").trim();
        context.fillStyle = style.getPropertyValue("--muted").trim();
        context.lineWidth = ratio;
        context.font = `${12 * ratio}px system-ui, sans-serif`;
        context.beginPath();
        context.moveTo(area.left, area.top);
        context.lineTo(area.left, bottom);
        context.lineTo(right, bottom);
        context.textAlign = "center";
        context.textBaseline = "top";
        const across = ticks(x_low, x_high, area.width / (90 * ratio));
        across.values.forEach((x, i) => {
            const [px] = this.to_screen(x, 0);
            context.moveTo(px, bottom);
            context.lineTo(px, bottom + 5 * ratio);
            const label = `${tick_label(x, across.step)}${i === across.values.length - 1 ? " m" : ""}`;
            const [{ at }] = apart([{ x: px, half: context.measureText(label).width / 2 }], canvas.width);
            context.fillText(label, at, bottom + 8 * ratio);
        });
        context.textAlign = "right";
        context.textBaseline = "middle";
        const up = ticks(y_low, y_high, area.height / (45 * ratio));
        for (const y of up.values) {
            const [, py] = this.to_screen(0, y);
            context.moveTo(area.left - 5 * ratio, py);
            context.lineTo(area.left, py);
            context.fillText(tick_label(y, up.step), area.left - 8 * ratio, py);
        }
        context.stroke();
    }

    // ---- mouse and touch

    listen() {
        const { canvas } = this;
        const hands = new Map();
        let pressed = null; // start of a possible click
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            hands.set(event.pointerId, event);
            pressed = event;
        });
        canvas.addEventListener("pointermove", (event) => {
            const before = hands.get(event.pointerId);
            if (!before) return;
            const other = [...hands.values()].find((hand) => hand.pointerId !== event.pointerId);
            if (other) {
                const reach = (hand) => Math.hypot(hand.clientX - other.clientX, hand.clientY - other.clientY);
                this.zoom(reach(event) / Math.max(reach(before), 1));
            } else {
                this.pan(event.clientX - before.clientX, event.clientY - before.clientY);
            }
            hands.set(event.pointerId, event);
        });
        canvas.addEventListener("pointerup", (event) => {
            const still = pressed && Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) < 4;
            if (this.pick && still && this.scale) this.pick(this.to_world(...this.place_of(event)));
        });
        for (const end of ["pointerup", "pointercancel"]) {
            canvas.addEventListener(end, (event) => hands.delete(event.pointerId));
        }
        canvas.addEventListener("wheel", (event) => {
            // The page scrolls past the picture unless it has the focus or Ctrl is held.
            if (document.activeElement !== canvas && !event.ctrlKey) return;
            event.preventDefault();
            this.zoom(1.0015 ** -event.deltaY, this.place_of(event));
        }, { passive: false });
        canvas.addEventListener("keydown", (event) => this.key(event));
    }

    /// Position of an event [device pixels].
    place_of(event) {
        const box = this.canvas.getBoundingClientRect();
        return [(event.clientX - box.left) * this.ratio, (event.clientY - box.top) * this.ratio];
    }

    key(event) {
        const step = 40;
        const moves = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (event.key in moves) this.pan(...moves[event.key]);
        else if (event.key === "+" || event.key === "=") this.zoom(1.25);
        else if (event.key === "-") this.zoom(0.8);
        else if (event.key === "0" || event.key === "Home") this.fit();
        else return;
        event.preventDefault();
    }
}
