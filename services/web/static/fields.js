// Fields of snapshots: names, displayed units, and notes.

/// factor: from the server's SI to the displayed unit. note: meaning of the values, if it is not obvious.
const known = {
    epsilon_q: { name: "deviatoric strain ε_q", unit: "–", mesh: "nodal mean of the elements around each node" },
    epsilon_q_plastic: { name: "plastic strain ε_q", unit: "–" },
    speed: { name: "velocity (magnitude)", unit: "m/s" },
    displacement: { name: "displacement |u|", unit: "m", mesh: "since the first dynamic stage began" },
    u_x: { name: "horizontal displacement u_x", unit: "m", mesh: "since the first dynamic stage began" },
    u_y: { name: "vertical displacement u_y", unit: "m", mesh: "since the first dynamic stage began" },
    sigma_v: { name: "vertical effective stress σ′_v", unit: "kPa", factor: 1e-3,
               mesh: "compression positive; nodal mean of the elements around each node, also across materials" },
    region: { name: "region", unit: "" },
    material: { name: "material", unit: "" },
    r_u: { name: "pore pressure ratio r_u", unit: "–", mesh: "mean of the wet elements around each node; none where the soil is dry",
           points: "as it was at the transfer, carried along" },
    pore_pressure: { name: "pore pressure u", unit: "kPa", factor: 1e-3 },
    mean_stress: { name: "mean effective stress", unit: "kPa", factor: 1e-3 },
};
const categories = ["region", "material"];
const places = ["x", "y"];

export const is_named = (field) => categories.includes(field);
export const field_name = (field) => known[field]?.name ?? field;
export const unit_of = (field) => known[field]?.unit ?? "";
/// "displacement |u| [m]"
export const field_label = (field) => field_name(field) + (unit_of(field) ? ` [${unit_of(field)}]` : "");
export const note_of = (field, is_mesh) => known[field]?.[is_mesh ? "mesh" : "points"] ?? "";
/// The fields of a snapshot that can be shown, in the server's order.
export const fields_of = (snapshot) => Object.keys(snapshot.columns).filter((field) => !places.includes(field));
/// Fields with a numeric scale.
export const numbers_of = (snapshot) => fields_of(snapshot).filter((field) => !is_named(field));

/// Converts a snapshot to the displayed units, and adds each point's material.
export function prepared(snapshot, materials_of_regions) {
    for (const [field, values] of Object.entries(snapshot.columns)) {
        const factor = known[field]?.factor;
        if (factor) snapshot.columns[field] = values.map((value) => value * factor);
    }
    add_material(snapshot, materials_of_regions);
    return snapshot;
}

/// From the point's region: one colour for regions that share a material.
function add_material(snapshot, materials_of_regions) {
    const of_region = snapshot.regions.map((name, i) => snapshot.region_materials?.[i] ?? materials_of_regions.get(name) ?? "unknown");
    const names = [...new Set(of_region)];
    if (names.length === 0 || !snapshot.columns.region) return;
    const index = Float32Array.from(of_region, (name) => names.indexOf(name));
    snapshot.columns.material = snapshot.columns.region.map((region) => index[region]);
    snapshot.materials = names;
}

/// Lowest and highest finite value; null when there is none.
export function extremes_of(values) {
    let [low, high] = [Infinity, -Infinity];
    for (const value of values) {
        if (value < low) low = value;
        if (value > high) high = value;
    }
    return low <= high ? [low, high] : null;
}

/// The 1st and 99th percentiles, extended to zero: a few outliers do not determine the scale.
export function reach_of(values) {
    const step = Math.max(1, Math.floor(values.length / 2000));
    const picked = new Float32Array(Math.ceil(values.length / step));
    let count = 0;
    for (let i = 0; i < values.length; i += step) if (Number.isFinite(values[i])) picked[count++] = values[i];
    const sample = picked.subarray(0, count).sort();
    const at = (share) => sample[Math.floor(share * (sample.length - 1))];
    return sample.length ? [Math.min(0, at(0.01)), Math.max(0, at(0.99))] : [0, 0];
}
