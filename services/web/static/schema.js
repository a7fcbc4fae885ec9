// Reads entries of the served JSON Schemas: shape, unit, range, default and help.
import * as api from "./api.js";

/// {study, scene} with every $ref resolved; a study's scene has the scene's schema.
export async function read_schemas() {
    const [scene, study] = (await Promise.all([api.read_schema("scene"), api.read_schema("study")])).map((root) => expand(root, root, []));
    study.properties.scene = { ...scene, description: study.properties.scene.description };
    return { scene, study };
}

/// A recursive definition becomes an entry of any shape, edited as JSON.
function expand(entry, root, trail) {
    if (Array.isArray(entry)) return entry.map((each) => expand(each, root, trail));
    if (entry === null || typeof entry !== "object") return entry;
    const { $ref, $defs, ...rest } = entry;
    if ($ref && trail.includes($ref)) return rest;
    const own = Object.fromEntries(Object.entries(rest).map(([name, each]) => [name, expand(each, root, trail)]));
    return $ref ? { ...expand(root.$defs[$ref.split("/").at(-1)], root, [...trail, $ref]), ...own } : own;
}

const is_number = (entry) => entry?.type === "number" || entry?.type === "integer";
const is_scalar = (entry) => is_number(entry) || ["string", "boolean"].includes(entry.type) || "enum" in entry;
const is_point = (entry) => entry?.type === "array" && is_number(entry.items) && entry.minItems === 2 && entry.maxItems === 2;

/// A name without commas, not a sentence.
const is_name = (entry) => entry?.type === "string" && ("enum" in entry || !entry.description || /name/.test(entry.description));

/// The editor of an entry: constant, scalar, choice, group, map, tuple, points, numbers, words, rows or text (plain JSON).
export function shape_of(entry) {
    if ("const" in entry) return "constant";
    if (entry.oneOf) return entry.oneOf.every(is_scalar) ? "scalar" : "choice";
    if (entry.properties) return "group";
    if (entry.type === "object" && typeof entry.additionalProperties === "object") return "map";
    if (entry.type === "array") {
        if (is_number(entry.items) && entry.minItems === entry.maxItems && entry.maxItems <= 4) return "tuple";
        if (is_point(entry.items)) return "points";
        if (is_number(entry.items)) return "numbers";
        if (is_name(entry.items) && !/=value/.test(entry.description)) return "words";
        if (entry.items) return "rows";
    }
    return is_scalar(entry) ? "scalar" : "text";
}

/// The branch of a choice that a value belongs to; the first if none.
export function branch_of(branches, value) {
    const kind = Array.isArray(value) ? "array" : typeof value;
    const at = branches.findIndex((branch) => {
        const tag = branch.properties?.type?.const;
        if (tag !== undefined) return value?.type === tag;
        return branch.type === kind || (branch.type === "integer" && kind === "number");
    });
    return Math.max(at, 0);
}
export const branch_name = (branch) => branch.properties?.type?.const ?? branch.description ?? branch.type;

/// The words that a scalar accepts, besides numbers.
export const words_of = (entry) => entry.enum ?? (entry.oneOf ?? []).flatMap((branch) => branch.enum ?? []);
export const takes_number = (entry) => is_number(entry) || Boolean(entry.oneOf?.some(is_number));

const shown = (number) => (Math.abs(number) >= 1e6 || (number !== 0 && Math.abs(number) < 1e-4) ? number.toExponential().replace("e+", "e")
    : String(number));
const of_number = (entry) => entry.oneOf?.find(is_number) ?? entry;

export function unit_of(entry) {
    const unit = of_number(entry).unit ?? entry.items?.unit ?? "";
    return unit === "1" ? "" : unit;
}

/// "0 to 1", "> 0, ≤ 1000"; empty without limits.
export function range_of(entry) {
    const { minimum, exclusiveMinimum, maximum, exclusiveMaximum } = of_number(entry);
    if (minimum !== undefined && maximum !== undefined) return `${shown(minimum)} to ${shown(maximum)}`;
    return [[minimum, "≥ "], [exclusiveMinimum, "> "], [maximum, "≤ "], [exclusiveMaximum, "< "]]
        .filter(([limit]) => limit !== undefined).map(([limit, sign]) => sign + shown(limit)).join(", ");
}

/// "1000 to 3200", the usual range; "": not in the schema.
export function plausible_of(entry) {
    const usual = of_number(entry)["x-plausible"];
    return usual ? `${shown(usual[0])} to ${shown(usual[1])}` : "";
}

/// Why a number is invalid or implausible; "": it is neither.
export function doubt_about(entry, value) {
    const limits = of_number(entry);
    if (typeof value !== "number") return "";
    if (limits.type === "integer" && !Number.isInteger(value)) return "a whole number is wanted";
    if (value < limits.minimum || value <= limits.exclusiveMinimum || value > limits.maximum || value >= limits.exclusiveMaximum) {
        return `outside of ${range_of(entry)}`;
    }
    const usual = limits["x-plausible"];
    return usual && value !== 0 && (value < usual[0] || value > usual[1]) ? `unusual: mostly ${plausible_of(entry)} ${unit_of(entry)}`.trim() : "";
}

/// "default 0.05 m", or "".
export function default_of(entry) {
    const value = entry.default;
    if (value === undefined || (typeof value === "object" && !Array.isArray(value)) || value === "" || value?.length === 0) return "";
    const text = Array.isArray(value) ? value.join(", ") : typeof value === "boolean" ? (value ? "yes" : "no") : String(value);
    return `default ${text} ${typeof value === "string" ? "" : unit_of(entry)}`.trim();
}

/// A minimal value of that shape: constants and required members.
export function skeleton(entry) {
    if ("const" in entry) return entry.const;
    if (entry.oneOf) return skeleton(entry.oneOf[0]);
    if (entry.type === "array") return [];
    if (entry.type !== "object") return entry.default ?? entry.enum?.[0] ?? "";
    const named = (entry.required ?? []).map((name) => [name, entry.properties[name]])
        .filter(([, each]) => "const" in each || each.properties || each.oneOf?.every((branch) => branch.properties?.type));
    return Object.fromEntries(named.map(([name, each]) => [name, skeleton(each)]));
}
