// Parts of a scene for pictures of the soil.
import { parts_of } from "./json_text.js";

/// The scene of a variant: with the study's overrides, then the variant's.
export function scene_of(study, variant) {
    const scene = structuredClone(study?.scene ?? {});
    const own = (study?.variants ?? []).find(({ name }) => name === variant)?.overrides ?? [];
    for (const each of [...(study?.overrides ?? []), ...own]) set(scene, each);
    return scene;
}

/// Applies "/pointer=value" like the phases: the value is JSON, else text; "-" appends to a list.
function set(scene, override) {
    const [pointer, text] = [override.slice(0, override.indexOf("=")), override.slice(override.indexOf("=") + 1)];
    const parts = parts_of(pointer);
    const last = parts.pop();
    const place = parts.reduce((at, part) => (at[key_in(at, part)] ??= {}), scene);
    place[key_in(place, last)] = value_of(text);
}
const key_in = (place, part) => (Array.isArray(place) && part === "-" ? place.length : part);

function value_of(text) {
    try {
        return JSON.parse(text);
    } catch {
        return text;
    }
}

/// region -> material
export const materials_in = (scene) => new Map((scene?.section?.regions ?? []).map(({ name, material }) => [name, material]));

const outlines_in = (scene) => (scene?.section?.regions ?? []).map((region) => region.polygon ?? []);

/// The original section, the toe, the gauges.
export function overlay_of(scene) {
    const ground = level_of_ground(scene);
    return { outlines: outlines_in(scene), toe: scene?.mpm?.runout?.toe ?? null,
             gauges: (scene?.mpm?.gauges ?? []).map(({ name, x }) => ({ name, x, y: ground(x) })) };
}

/// The initial phreatic line, extended horizontally to the section's width; null: none.
export function water_of(scene) {
    const line = scene?.fem?.water?.line ?? scene?.transfer?.phreatic_line ?? scene?.lem?.water?.line;
    const xs = outlines_in(scene).flat().map(([x]) => x);
    if (!line?.length || xs.length === 0) return null;
    const [low, high] = [Math.min(...xs), Math.max(...xs)];
    const inside = line.filter(([x]) => x > low && x < high);
    return [[low, level_at(line, low)], ...inside, [high, level_at(line, high)]];
}

/// y at x of points from left to right.
export function level_at(line, x) {
    const after = line.findIndex((point) => point[0] >= x);
    if (after === 0) return line[0][1];
    if (after < 0) return line.at(-1)[1];
    const [[x1, y1], [x2, y2]] = [line[after - 1], line[after]];
    return y1 + ((x - x1) / Math.max(x2 - x1, 1e-12)) * (y2 - y1);
}

/// Level of gauges: the terrain, else the level floor.
function level_of_ground(scene) {
    const terrain = scene?.mpm?.terrain;
    const line = Array.isArray(terrain) ? terrain : terrain?.line;
    return (x) => (Array.isArray(line) && line.length ? level_at(line, x) : scene?.mpm?.floor?.level ?? 0);
}
