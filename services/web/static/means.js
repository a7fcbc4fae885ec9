// Studies with repeats: means over repeats shown like rows of results, and the repeats of each mean.

const names_in = (text) => (text ?? "").split("; ").filter(Boolean);

function flag_of_draws(code, draws, message) {
    return draws.length ? [{ code, severity: "questionable", message: `${message}: ${draws.join(", ")}`, pointer: "" }] : [];
}

/// The service's means as rows of the table of results; a questionable repeat makes the mean questionable.
export function mean_rows(means) {
    return means.map((mean) => {
        const missing = names_in(mean.missing_draws);
        const doubtful = names_in(mean.questionable_draws);
        const flags = [...flag_of_draws("missing_draws", missing, "the mean leaves them out"),
                       ...flag_of_draws("questionable_draws", doubtful, "the mean includes them")];
        return { ...mean, mean: true, flags, questionable: flags.length > 0, at_rest: null };
    });
}

/// The variant of a repeat; "" for repeats in a study without variants.
export function repeated_variant(name, study) {
    const made = (study?.variants ?? []).find((variant) => variant.name === name);
    return made?.made_by === "draws" ? name.replace(/_?d\d+$/, "") : name;
}

export function draws_of(mean, rows, study) {
    return rows.filter((row) => row.transfer_time === mean.transfer_time && repeated_variant(row.variant, study) === mean.variant);
}
