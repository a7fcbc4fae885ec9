// What pictures of the soil show of the scene it began with.

/// region -> material
export const materials_in = (scene) => new Map((scene?.section?.regions ?? []).map(({ name, material }) => [name, material]));

const outlines_in = (scene) => (scene?.section?.regions ?? []).map((region) => region.polygon ?? []);

/// The section as built, the toe, the gauges.
export function overlay_of(scene) {
    const ground = level_of_ground(scene);
    return { outlines: outlines_in(scene), toe: scene?.mpm?.runout?.toe ?? null,
             gauges: (scene?.mpm?.gauges ?? []).map(({ name, x }) => ({ name, x, y: ground(x) })) };
}

/// The phreatic line that the scene begins with, level beyond its first and last point, as wide as the section; null: the scene has none.
export function water_of(scene) {
    const line = scene?.fem?.water?.line ?? scene?.transfer?.phreatic_line ?? scene?.lem?.water?.line;
    const xs = outlines_in(scene).flat().map(([x]) => x);
    if (!line?.length || xs.length === 0) return null;
    const [low, high] = [Math.min(...xs), Math.max(...xs)];
    const inside = line.filter(([x]) => x > low && x < high);
    return [[low, level_at(line, low)], ...inside, [high, level_at(line, high)]];
}

/// y at x of points from left to right.
function level_at(line, x) {
    const after = line.findIndex((point) => point[0] >= x);
    if (after === 0) return line[0][1];
    if (after < 0) return line.at(-1)[1];
    const [[x1, y1], [x2, y2]] = [line[after - 1], line[after]];
    return y1 + ((x - x1) / Math.max(x2 - x1, 1e-12)) * (y2 - y1);
}

/// Where gauges stand: on the terrain, else on the level floor.
function level_of_ground(scene) {
    const terrain = scene?.mpm?.terrain;
    const line = Array.isArray(terrain) ? terrain : terrain?.line;
    return (x) => (Array.isArray(line) && line.length ? level_at(line, x) : scene?.mpm?.floor?.level ?? 0);
}
