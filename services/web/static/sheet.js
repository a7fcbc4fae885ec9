// A sheet with pictures of the soil, their subject, scale and notes, as shapes that look the same on a canvas (PNG, films) and in SVG. The
// soil stays a bitmap in both.
import { band_css, region_css, scale_css } from "./colours.js";
import { svg } from "./dom.js";
import { field_label, is_named } from "./fields.js";
import { number } from "./format.js";

const pad = 14; // [CSS px]
const font = 'system-ui, "DejaVu Sans", sans-serif';
const measure = document.createElement("canvas").getContext("2d");

function width_of(text, size, weight = "normal") {
    measure.font = `${weight} ${size}px ${font}`;
    return measure.measureText(text).width;
}

/// Breaks a text into lines of this width.
export function wrapped(text, size, room, weight = "normal") {
    const lines = [""];
    for (const word of text.split(" ")) {
        const longer = lines.at(-1) ? `${lines.at(-1)} ${word}` : word;
        if (width_of(longer, size, weight) <= room || !lines.at(-1)) lines[lines.length - 1] = longer;
        else lines.push(word);
    }
    return lines;
}

/// {title, parts: [{view, caption}] side by side, colour: as for PointView.show, names: of a named field, grey: some have no value, notes:
/// [text]} -> {width, height, shapes, ground}. view: a PointView that was just painted.
export function sheet_of({ title, parts, colour, names, grey, notes }) {
    const style = getComputedStyle(document.documentElement);
    const [text, muted, ground] = ["--text", "--muted", "--card"].map((name) => style.getPropertyValue(name).trim());
    const sizes = parts.map(({ view: { canvas, ratio } }) => [canvas.width / ratio, canvas.height / ratio]);
    const width = sizes.reduce((sum, [wide]) => sum + wide + pad, pad);
    const shapes = [];
    let y = pad;
    const write = (words, size, x = pad, colour_of = text, weight = "normal") => shapes.push({ text: words, x, y: y + size, size, colour: colour_of, weight });
    for (const line of wrapped(title, 17, width - 2 * pad, "bold")) {
        write(line, 17, pad, text, "bold");
        y += 23;
    }
    let x = pad;
    const captions = parts.map(({ caption }, i) => wrapped(caption, 13, sizes[i][0]));
    parts.forEach(({ view }, i) => {
        captions[i].forEach((line, k) => shapes.push({ text: line, x, y: y + 13 + 18 * k, size: 13, colour: text, weight: "normal" }));
        shapes.push({ image: view.canvas, x, y: y + 6 + 18 * Math.max(...captions.map((lines) => lines.length)), width: sizes[i][0], height: sizes[i][1] });
        x += sizes[i][0] + pad;
    });
    y += 6 + 18 * Math.max(...captions.map((lines) => lines.length)) + Math.max(...sizes.map(([, high]) => high)) + 10;
    y = add_legend({ shapes, colour, names, grey, text, muted, width }, y);
    for (const line of notes.filter(Boolean).flatMap((note) => wrapped(note, 12, width - 2 * pad))) {
        write(line, 12, pad, muted);
        y += 17;
    }
    return { width: Math.ceil(width), height: Math.ceil(y + pad), shapes, ground };
}

/// Returns the lower end.
function add_legend({ shapes, colour, names, grey, text, muted, width }, y) {
    const write = (words, x, at, size, colour_of) => shapes.push({ text: words, x, y: at, size, colour: colour_of, weight: "normal" });
    if (is_named(colour.field)) {
        let [x, row] = [pad, y];
        names.forEach((name, i) => {
            const wide = 34 + width_of(name, 13);
            if (x + wide > width - pad) [x, row] = [pad, row + 20];
            shapes.push({ rect: [x, row, 14, 14], colour: region_css(i) });
            write(name, x + 20, row + 12, 13, text);
            x += wide;
        });
        return row + 26;
    }
    const { low, high } = colour;
    write(field_label(colour.field), pad, y + 13, 13, text);
    const colours = colour.contours ? band_css : scale_css.filter((_, i) => i % 4 === 0);
    const long = Math.min(420, width - 2 * pad);
    colours.forEach((css, i) => shapes.push({ rect: [pad + (i * long) / colours.length, y + 20, long / colours.length + 0.5, 16], colour: css }));
    for (const share of [0, 0.25, 0.5, 0.75, 1]) {
        const label = number(low + share * (high - low), 3);
        write(label, pad + share * (long - width_of(label, 12)), y + 50, 12, muted);
    }
    if (grey) {
        shapes.push({ rect: [pad + long + 16, y + 21, 14, 14], colour: "#8b93a1" });
        write("no value there", pad + long + 36, y + 33, 13, text);
    }
    return y + 62;
}

/// Draws the sheet. The canvas gets its size but never shrinks in height: a film has one size.
export function draw_sheet(canvas, { width, height, shapes, ground }, ratio = 2) {
    const [wide, high] = [2 * Math.ceil((width * ratio) / 2), 2 * Math.ceil((height * ratio) / 2)];
    if (canvas.width !== wide) canvas.width = wide;
    if (canvas.height < high) canvas.height = high;
    const context = canvas.getContext("2d");
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = ground;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.scale(ratio, ratio);
    for (const shape of shapes) {
        context.fillStyle = shape.colour;
        if (shape.image) context.drawImage(shape.image, shape.x, shape.y, shape.width, shape.height);
        else if (shape.rect) context.fillRect(...shape.rect);
        else {
            context.font = `${shape.weight} ${shape.size}px ${font}`;
            context.fillText(shape.text, shape.x, shape.y);
        }
    }
}

export function sheet_as_svg({ width, height, shapes, ground }) {
    const made = shapes.map((shape) => {
        if (shape.image) return svg("image", { href: shape.image.toDataURL("image/png"), x: shape.x, y: shape.y, width: shape.width, height: shape.height });
        if (shape.rect) {
            const [x, y, wide, high] = shape.rect;
            return svg("rect", { x, y, width: wide, height: high, fill: shape.colour });
        }
        return svg("text", { x: shape.x, y: shape.y, fill: shape.colour, "font-size": shape.size, "font-weight": shape.weight, "font-family": font }, shape.text);
    });
    return svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height }, svg("rect", { width, height, fill: ground }), ...made);
}
