// Colours of the particle viewer: a scale for numbers on light and dark backgrounds, and distinct colours for regions. 32-bit values are
// little-endian RGBA, as in ImageData.
import { band_count } from "./contours.js";

const anchors = ["#2b5ea7", "#2a8fb0", "#4fae86", "#d9a92c", "#dd6b20", "#b3132b"];
// Twelve colours that are distinguishable with colour blindness, on light and dark backgrounds (tested).
const region_colours = ["#2f7fc1", "#c8791e", "#3a9c6e", "#881048", "#d0a0d0", "#686000", "#0000f8", "#b0b800", "#f038f8", "#005078",
                        "#906080", "#8808b8"];

const channels = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

export function packed(hex) {
    const [red, green, blue] = channels(hex);
    return ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;
}

/// Mixes the first colour with `share` of the second.
export function mixed(colour, other, share) {
    let result = 0xff000000;
    for (const shift of [0, 8, 16]) {
        const from = (colour >>> shift) & 255;
        result |= Math.round(from + share * (((other >>> shift) & 255) - from)) << shift;
    }
    return result >>> 0;
}

export const scale_steps = 256;

function blend(fraction) {
    const at = fraction * (anchors.length - 1);
    const left = Math.min(Math.floor(at), anchors.length - 2);
    const share = at - left;
    const [a, b] = [channels(anchors[left]), channels(anchors[left + 1])];
    const mixed = a.map((value, i) => Math.round(value + share * (b[i] - value)));
    return "#" + mixed.map((value) => value.toString(16).padStart(2, "0")).join("");
}

export const scale_css = Array.from({ length: scale_steps }, (_, i) => blend(i / (scale_steps - 1)));
/// Scale for numbers, low to high.
export const scale_packed = Uint32Array.from(scale_css, packed);
export const scale_gradient = `linear-gradient(to right, ${anchors.join(", ")})`;
/// The same in steps, for contours.
export const band_css = Array.from({ length: band_count }, (_, i) => blend((i + 0.5) / band_count));
export const band_colours = Uint32Array.from(band_css, packed);
export const band_gradient = `linear-gradient(to right, ${band_css.map((colour, i) =>
    `${colour} ${(100 * i) / band_count}% ${(100 * (i + 1)) / band_count}%`).join(", ")})`;

export const region_count = region_colours.length;
export const region_css = (index) => region_colours[index % region_colours.length];

export const unknown_css = "#8b93a1";
