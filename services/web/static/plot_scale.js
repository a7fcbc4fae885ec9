// Round values for axes, ranges, and thinning of long curves.
import { number } from "./format.js";

/// About `wanted` round values that cover [low, high].
export function ticks(low, high, wanted) {
    const raw = (high - low) / Math.max(wanted, 1);
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = power * [1, 2, 2.5, 5, 10].find((factor) => factor * power >= raw * 0.999);
    const values = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1) values.push(i * step);
    return { values, step };
}

/// Powers of ten in [low, high], with their multiples by 2 and 5 if there are few.
export function log_ticks(low, high) {
    const few = Math.log10(high / low) < 3;
    const values = [];
    for (let power = 10 ** Math.floor(Math.log10(low)); power <= high; power *= 10) {
        values.push(...(few ? [1, 2, 5] : [1]).map((factor) => factor * power).filter((value) => value >= low && value <= high));
    }
    return values;
}

export function tick_label(value, step) {
    if (Math.abs(value) < 1e-9 * step) return "0";
    // As many digits as distinguish the ticks: coordinates may be 456,230 m with ticks of 10 m.
    const digits = 1 + Math.floor(Math.log10(Math.abs(value)) + 1e-9) - Math.floor(Math.log10(step) + 1e-9);
    if ((Math.abs(value) >= 1e5 && digits <= 3) || Math.abs(value) >= 1e7 || step < 1e-4) return number(value, Math.max(3, digits + 1));
    const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
    const fits = Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) < 1e-6;
    return value.toFixed(fits ? decimals : decimals + 1);
}

/// Range of the finite values, slightly widened; always includes `least`.
export function range_of(lists, least) {
    let low = Infinity;
    let high = -Infinity;
    const widen = (value) => {
        if (value === null || !Number.isFinite(value)) return;
        low = Math.min(low, value);
        high = Math.max(high, value);
    };
    for (const list of lists) list.forEach(widen);
    least.forEach(widen);
    if (low > high) return [0, 1];
    if (low === high) return [low - (Math.abs(low) || 1) / 2, high + (Math.abs(high) || 1) / 2];
    return [low, high];
}

const most_widened = 3; // limit for widening the range to show a level

/// The range, widened to the levels that do not flatten the curves.
export function widened(range, levels) {
    let [low, high] = range;
    for (const level of [...levels].sort((a, b) => Math.abs(a - (low + high) / 2) - Math.abs(b - (low + high) / 2))) {
        const wider = [Math.min(low, level), Math.max(high, level)];
        if (wider[1] - wider[0] <= most_widened * (range[1] - range[0])) [low, high] = wider;
    }
    return [low, high];
}

/// Indices of a thinned curve: keeps the lowest and highest point per pixel column, so no peak is lost.
export function thinned(xs, ys, columns) {
    if (xs.length <= 4 * columns) return xs.map((_, i) => i);
    const kept = [];
    const per_column = xs.length / columns;
    for (let column = 0; column < columns; column += 1) {
        const first = Math.floor(column * per_column);
        const end = Math.min(xs.length, Math.floor((column + 1) * per_column));
        let lowest = first;
        let highest = first;
        for (let i = first; i < end; i += 1) {
            if (ys[i] < ys[lowest]) lowest = i;
            if (ys[i] > ys[highest]) highest = i;
        }
        kept.push(...[...new Set([first, lowest, highest, end - 1])].sort((a, b) => a - b));
    }
    return kept;
}
