// Carries a user's edits over to a newly generated study.
import { pointer_of } from "./json_text.js";

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
const is_object = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
const is_named = (list) => Array.isArray(list) && list.every((each) => typeof each?.name === "string");
const by_name = (list) => Object.fromEntries(list.map((each) => [each.name, each]));

/// base: as generated before; mine: base with the user's edits; theirs: as generated now. Returns {value, lost: pointers of edits that
/// could not be carried over, because their place is gone or a list of numbers was generated again}.
export function carried(base, mine, theirs) {
    const lost = [];
    const merge = (was, own, made, way) => {
        if (same(own, was) || same(own, made)) return made;
        if (same(made, was) || own === undefined) return own;
        if (is_named(own) && is_named(made)) return Object.values(merge(by_name(is_named(was) ? was : []), by_name(own), by_name(made), way));
        if (is_object(own) && is_object(made)) {
            const names = new Set([...Object.keys(made), ...Object.keys(own)]);
            const entries = [...names].map((name) => [name, merge(was?.[name], own[name], made[name], [...way, name])]);
            return Object.fromEntries(entries.filter(([, value]) => value !== undefined));
        }
        if (made !== undefined && !Array.isArray(made)) return own;
        lost.push(pointer_of(way));
        return made;
    };
    return { value: merge(base, mine, theirs, []), lost };
}
