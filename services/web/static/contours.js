// Filled contours of nodal values over quads, drawn into an image: bands of one colour with smooth borders. Each quad is four triangles
// about its centre, which has the mean of the corners, like a bilinear element. A quad with a corner without a value has the colour
// `unknown`.

export const band_count = 12;

/// The band of a share of the scale (0 to 1); values beyond the ends get the end bands.
export const band_of = (share) => Math.min(band_count - 1, Math.max(0, Math.floor(share * band_count)));

/// image: {pixels, width, height}; x, y: nodes [device pixels]; share: of the scale at each node, or NaN; palette: one colour per band;
/// unknown: colour of quads without a value.
export function fill_contours(image, { x, y, share, quads, palette, unknown }) {
    const corner = (i) => [x[i], y[i], share[i]];
    for (let q = 0; q < quads.length; q += 4) {
        const around = [quads[q], quads[q + 1], quads[q + 2], quads[q + 3]].map(corner);
        const centre = [0, 1, 2].map((k) => (around[0][k] + around[1][k] + around[2][k] + around[3][k]) / 4);
        for (let k = 0; k < 4; k += 1) fill_triangle(image, around[k], around[(k + 1) & 3], centre, palette, unknown);
    }
}

/// Corners [x, y, share]. Fills pixels whose centre is inside, like raster.js, so that neighbours leave no gap.
function fill_triangle(image, a, b, c, palette, unknown) {
    const first = Math.max(Math.ceil(Math.min(a[1], b[1], c[1]) - 0.5), 0);
    const end = Math.min(Math.ceil(Math.max(a[1], b[1], c[1]) - 0.5), image.height);
    const area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    const by_x = ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) / area;
    const by_y = ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0])) / area;
    const has_value = Number.isFinite(by_x) && Number.isFinite(by_y);
    for (let row = first; row < end; row += 1) {
        const at = row + 0.5;
        const [left, right] = crossings(at, a, b, c);
        const begin = Math.max(Math.ceil(left - 0.5), 0);
        const stop = Math.min(Math.ceil(right - 0.5), image.width);
        let share = a[2] + by_x * (begin + 0.5 - a[0]) + by_y * (at - a[1]);
        for (let i = row * image.width + begin; i < row * image.width + stop; i += 1, share += by_x) {
            image.pixels[i] = has_value ? palette[band_of(share)] : unknown;
        }
    }
}

/// Where the row at this height enters and leaves the triangle.
function crossings(at, ...corners) {
    let [left, right] = [Infinity, -Infinity];
    for (let k = 0; k < 3; k += 1) {
        const [from, to] = [corners[k], corners[(k + 1) % 3]];
        if (from[1] <= at === to[1] <= at) continue;
        const place = from[0] + ((at - from[1]) / (to[1] - from[1])) * (to[0] - from[0]);
        left = Math.min(left, place);
        right = Math.max(right, place);
    }
    return [left, right];
}
