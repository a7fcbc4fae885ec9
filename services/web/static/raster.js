// Pixels of soil: squares for particles, quads and their edges for a mesh, drawn into an image; much faster than a canvas's paths, without
// a GPU. Colours are 32-bit values as in ImageData; coordinates are device pixels.
import { mixed } from "./colours.js";

const short_span = 24; // pixels; shorter spans are faster in a loop than with fill()

function span(image, row, first, end, colour) {
    const { pixels, width } = image;
    const begin = row * width + first;
    const stop = row * width + end;
    if (stop - begin > short_span) pixels.fill(colour, begin, stop);
    else for (let i = begin; i < stop; i += 1) pixels[i] = colour;
}

/// image: {pixels: Uint32Array, width, height}.
export function fill_square(image, left, top, size, colour) {
    const first = Math.max(left, 0);
    const end = Math.min(left + size, image.width);
    if (first >= end) return;
    const last_row = Math.min(top + size, image.height);
    for (let row = Math.max(top, 0); row < last_row; row += 1) span(image, row, first, end, colour);
}

/// The quad through the nodes a, b, c, d at x and y. Neighbours share their edge without gap or overlap.
export function fill_quad(image, x, y, [a, b, c, d], colour) {
    const lowest = Math.min(y[a], y[b], y[c], y[d]);
    const highest = Math.max(y[a], y[b], y[c], y[d]);
    const last_row = Math.min(Math.ceil(highest - 0.5), image.height);
    for (let row = Math.max(Math.ceil(lowest - 0.5), 0); row < last_row; row += 1) {
        let left = Infinity;
        let right = -Infinity;
        const cross = (from, to) => {
            const at = row + 0.5;
            if (y[from] <= at === y[to] <= at) return;
            const place = x[from] + ((at - y[from]) / (y[to] - y[from])) * (x[to] - x[from]);
            if (place < left) left = place;
            if (place > right) right = place;
        };
        cross(a, b);
        cross(b, c);
        cross(c, d);
        cross(d, a);
        if (left <= right) span(image, row, Math.max(Math.ceil(left - 0.5), 0), Math.min(Math.ceil(right - 0.5), image.width), colour);
    }
}

/// A line one pixel wide from node a to node b; share_of_colour: its opacity.
export function draw_edge(image, x, y, a, b, colour, share_of_colour = 1) {
    const { pixels, width, height } = image;
    const [dx, dy] = [x[b] - x[a], y[b] - y[a]];
    const steps = Math.ceil(Math.max(Math.abs(dx), Math.abs(dy)));
    if (!(steps < 4 * (width + height))) return; // far outside, or not a number
    for (let i = 0; i <= steps; i += 1) {
        const share = steps ? i / steps : 0;
        const column = Math.floor(x[a] + share * dx);
        const row = Math.floor(y[a] + share * dy);
        if (!(column >= 0 && column < width && row >= 0 && row < height)) continue;
        const at = row * width + column;
        pixels[at] = share_of_colour === 1 ? colour : mixed(pixels[at], colour, share_of_colour);
    }
}
