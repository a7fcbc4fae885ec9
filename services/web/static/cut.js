// Values of a snapshot along a straight cut: interpolated in a mesh like its contours; from points, the nearest one within their spacing.
// null: no soil, or no value.

const samples = 240;

/// {distance, x, y, value} at equal intervals from the first end to the second.
export function values_along(snapshot, field, [from, to], spacing) {
    const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
    const along = (axis) => Array.from({ length: samples + 1 }, (_, i) => from[axis] + ((to[axis] - from[axis]) * i) / samples);
    const cut = { distance: Array.from({ length: samples + 1 }, (_, i) => (length * i) / samples), x: along(0), y: along(1),
                  value: new Array(samples + 1).fill(null) };
    if (!(length > 0) || !snapshot.columns[field]) return cut;
    const line = { from, direction: [(to[0] - from[0]) / length, (to[1] - from[1]) / length], step: length / samples };
    if (snapshot.quads) of_mesh(snapshot, field, line, cut);
    else of_points(snapshot, field, line, cut, spacing);
    return cut;
}

/// Distance of a place along the line and to its left [m].
function seen_from({ from, direction: [dx, dy] }, x, y) {
    const [rx, ry] = [x - from[0], y - from[1]];
    return [rx * dx + ry * dy, ry * dx - rx * dy];
}

function of_mesh({ columns: { x, y, ...rest }, quads }, field, line, { value }) {
    const values = rest[field];
    const corner = (i) => ({ place: seen_from(line, x[i], y[i]), value: values[i] });
    for (let q = 0; q < quads.length; q += 4) {
        const around = [quads[q], quads[q + 1], quads[q + 2], quads[q + 3]].map(corner);
        const sides = around.map(({ place }) => place[1]);
        if (Math.min(...sides) > 0 || Math.max(...sides) < 0) continue;
        const mean = (of) => around.reduce((sum, each) => sum + of(each) / 4, 0);
        const centre = { place: [mean(({ place }) => place[0]), mean(({ place }) => place[1])], value: mean((each) => each.value) };
        for (let k = 0; k < 4; k += 1) of_triangle([around[k], around[(k + 1) & 3], centre], line.step, value);
    }
}

/// In the line's own coordinates (s along it, d beside it) the samples have d = 0.
function of_triangle([a, b, c], step, value) {
    const places = [a, b, c].map(({ place }) => place[0]);
    const first = Math.max(0, Math.ceil(Math.min(...places) / step - 1e-9));
    const last = Math.min(value.length - 1, Math.floor(Math.max(...places) / step + 1e-9));
    const [[s_a, d_a], [s_b, d_b], [s_c, d_c]] = [a.place, b.place, c.place];
    const area = (s_b - s_a) * (d_c - d_a) - (s_c - s_a) * (d_b - d_a);
    for (let i = first; i <= last; i += 1) {
        const s = i * step;
        const share_b = ((s - s_a) * (d_c - d_a) - (s_c - s_a) * (0 - d_a)) / area;
        const share_c = ((s_b - s_a) * (0 - d_a) - (s - s_a) * (d_b - d_a)) / area;
        const share_a = 1 - share_b - share_c;
        if (!(Math.min(share_a, share_b, share_c) >= -1e-7)) continue;
        const here = share_a * a.value + share_b * b.value + share_c * c.value;
        if (Number.isFinite(here)) value[i] = here;
    }
}

function of_points({ columns: { x, y, ...rest }, count }, field, line, { value }, spacing) {
    const values = rest[field];
    const nearest = new Array(value.length).fill(spacing ** 2);
    for (let p = 0; p < count; p += 1) {
        const [s, d] = seen_from(line, x[p], y[p]);
        if (Math.abs(d) >= spacing) continue;
        const first = Math.max(0, Math.ceil((s - spacing) / line.step));
        const last = Math.min(value.length - 1, Math.floor((s + spacing) / line.step));
        for (let i = first; i <= last; i += 1) {
            const square = (i * line.step - s) ** 2 + d ** 2;
            if (square >= nearest[i]) continue;
            nearest[i] = square;
            value[i] = Number.isFinite(values[p]) ? values[p] : null;
        }
    }
}
