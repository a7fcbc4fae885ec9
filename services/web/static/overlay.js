// Drawings over the soil: the original section, the toe, gauges, the phreatic line, displacement vectors, the cut of a profile. Each takes
// the canvas's context, the view's to_screen and its device pixels per CSS pixel.

const vector_room = 26; // [CSS px] between vectors
const longest_vector = 44; // [CSS px]

function dash(context, ratio, ...lengths) {
    context.setLineDash(lengths.map((length) => length * ratio));
}

function trace(context, to_screen, points) {
    context.beginPath();
    points.forEach(([x, y], i) => (i ? context.lineTo(...to_screen(x, y)) : context.moveTo(...to_screen(x, y))));
    context.stroke();
}

export function draw_outlines({ context, to_screen, ratio }, outlines) {
    context.lineWidth = ratio;
    dash(context, ratio, 5, 4);
    for (const outline of outlines) trace(context, to_screen, outline);
    dash(context, ratio);
}

function draw_wedge({ context, to_screen, ratio }, at, filled) {
    const [px, py] = to_screen(...at);
    const d = 6 * ratio;
    context.lineWidth = 1.5 * ratio;
    context.beginPath();
    context.moveTo(px, py);
    context.lineTo(px - d, py - 1.8 * d);
    context.lineTo(px + d, py - 1.8 * d);
    context.closePath();
    if (filled) context.fill();
    else context.stroke();
    return [px, py - 1.8 * d];
}

export const draw_toe = (pen, toe) => draw_wedge(pen, toe, true);

/// Centres and lines of names beside each other and, where they would meet, above each other; none passes an edge. labels: [{x: wanted
/// centre, half: width}] from left to right.
export function apart(labels, width) {
    const ends = []; // of the last name in each line
    return labels.map(({ x, half }) => {
        const at = Math.max(half, Math.min(width - half, x));
        const free = ends.findIndex((end) => end < at - half);
        const line = free < 0 ? ends.length : free;
        ends[line] = at + half;
        return { at, line };
    });
}

/// gauges: [{name, x, y}], drawn as open wedges with their names.
export function draw_gauges(pen, gauges) {
    const { context, ratio } = pen;
    context.font = `${11 * ratio}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "bottom";
    const { width } = context.canvas;
    const drawn = gauges.map(({ name, x, y }) => ({ name, half: context.measureText(name).width / 2 + ratio, place: draw_wedge(pen, [x, y], false) }))
        .map((each) => ({ ...each, x: each.place[0] })).filter(({ x }) => x >= 0 && x <= width).sort((a, b) => a.x - b.x);
    const top = Math.min(...drawn.map(({ place }) => place[1]));
    apart(drawn, width).forEach(({ at, line }, i) => context.fillText(drawn[i].name, at, top - (2 + 13 * line) * ratio));
}

/// halo: background colour, so that the line is visible on any soil.
export function draw_water({ context, to_screen, ratio }, line, halo) {
    const colour = context.strokeStyle;
    context.strokeStyle = halo;
    context.lineWidth = 5 * ratio;
    trace(context, to_screen, line);
    context.strokeStyle = colour;
    context.lineWidth = 2 * ratio;
    dash(context, ratio, 9, 4);
    trace(context, to_screen, line);
    dash(context, ratio);
}

/// Length of the longest displacement [m].
export function longest_of({ columns: { u_x, u_y } }) {
    return u_x.reduce((longest, each, i) => Math.max(longest, Math.hypot(each, u_y[i])), 0);
}

/// Displacements at nodes with enough distance to see each arrow; the longest is `longest_vector` long.
export function draw_vectors({ context, to_screen, ratio }, snapshot, halo) {
    const { columns: { x, y, u_x, u_y }, count } = snapshot;
    const longest = longest_of(snapshot);
    if (longest === 0) return;
    const factor = (longest_vector * ratio) / longest;
    const taken = new Set();
    context.beginPath();
    for (let i = 0; i < count; i += 1) {
        const [px, py] = to_screen(x[i], y[i]);
        const place = `${Math.floor(px / (vector_room * ratio))}/${Math.floor(py / (vector_room * ratio))}`;
        if (taken.has(place)) continue;
        taken.add(place);
        draw_arrow(context, px, py, u_x[i] * factor, -u_y[i] * factor, ratio);
    }
    const colour = context.strokeStyle;
    context.strokeStyle = halo;
    context.lineWidth = 3.2 * ratio;
    context.stroke();
    context.strokeStyle = colour;
    context.lineWidth = 1.3 * ratio;
    context.stroke();
}

function draw_arrow(context, x, y, dx, dy, ratio) {
    const length = Math.hypot(dx, dy);
    if (length < 1.5 * ratio) return;
    const head = Math.min(5 * ratio, 0.45 * length);
    const [ux, uy] = [dx / length, dy / length];
    context.moveTo(x, y);
    context.lineTo(x + dx, y + dy);
    for (const side of [-1, 1]) {
        context.moveTo(x + dx, y + dy);
        context.lineTo(x + dx - head * (ux + side * 0.5 * uy), y + dy - head * (uy - side * 0.5 * ux));
    }
}

export function draw_cut({ context, to_screen, ratio }, ends) {
    context.lineWidth = 2 * ratio;
    trace(context, to_screen, ends);
    context.font = `bold ${13 * ratio}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "bottom";
    ends.forEach(([x, y], i) => {
        const [px, py] = to_screen(x, y);
        context.beginPath();
        context.arc(px, py, 3.5 * ratio, 0, 2 * Math.PI);
        context.fill();
        context.fillText("AB"[i], px, py - 6 * ratio);
    });
}
