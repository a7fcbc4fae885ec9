// Numeric differences between the variants of a study, as abscissas for results.

/// The value at a JSON pointer; undefined: missing.
function value_at(document, pointer) {
    return pointer.split("/").slice(1).map((part) => part.replaceAll("~1", "/").replaceAll("~0", "~"))
        .reduce((inside, part) => (inside !== null && typeof inside === "object" ? inside[part] : undefined), document);
}

/// {pointer: number} of a variant's numeric overrides.
function numbers_in(overrides) {
    const pairs = overrides.map((each) => [each.slice(0, each.indexOf("=")), each.slice(each.indexOf("=") + 1)]);
    return new Map(pairs.filter(([, text]) => text.trim() !== "" && Number.isFinite(Number(text))).map(([pointer, text]) => [pointer, Number(text)]));
}

/// [{pointer, value_of(variant): a number, or null where neither the variant nor the scene has one}], those with at least two different
/// numbers.
export function parameters_of(study) {
    const variants = study?.variants ?? [];
    const numbers = new Map(variants.map(({ name, overrides }) => [name, numbers_in(overrides ?? [])]));
    const own = new Map(variants.map(({ name, overrides }) => [name, new Set((overrides ?? []).map((each) => each.slice(0, each.indexOf("="))))]));
    const shared = numbers_in(study?.overrides ?? []);
    const parameter = (pointer) => {
        const inherited = shared.get(pointer) ?? value_at(study.scene, pointer);
        const value_of = (variant) => {
            if (numbers.get(variant)?.has(pointer)) return numbers.get(variant).get(pointer);
            return !own.get(variant)?.has(pointer) && typeof inherited === "number" ? inherited : null;
        };
        return { pointer, value_of };
    };
    const pointers = [...new Set([...numbers.values()].flatMap((of) => [...of.keys()]))];
    return pointers.map(parameter)
        .filter(({ value_of }) => new Set(variants.map(({ name }) => value_of(name)).filter((value) => value !== null)).size > 1);
}
