// Telemetry fields by plot, in order, with their names. A plot appears when at least one of its fields has data; other fields get one plot
// each under "all other monitors".
export const panels = [
    { title: "Crest displacement", y: "displacement [m]", unit: "m",
      fields: { crest_dx: "horizontal", crest_dy: "vertical", crest_displacement: "total" } },
    { title: "Kinetic energy", y: "kinetic energy [J]", unit: "J", fields: { kinetic_energy: "kinetic" } },
    { title: "Liquefaction depth", y: "depth below the ground [m]", unit: "m",
      fields: { liquefaction_depth: "deepest liquefied soil", critical_depth: "critical depth" } },
    { title: "Pore pressure ratio", y: "r_u [–]", unit: "", fields: { r_u_max: "largest" } },
    { title: "Failure surfaces", y: "number of surfaces [–]", unit: "", fields: { failure_surfaces: "bands through the body" } },
    { title: "Jacobian ratio, averages", y: "|J_t| / |J_0| [–]", unit: "",
      fields: { jacobian_ratio_avg: "strained elements", jacobian_least_avg: "their worst corners" } },
    { title: "Deviatoric strain, average", y: "ε_q [–]", unit: "", fields: { epsilon_q_avg: "strained elements" } },
    { title: "Front", y: "distance from the toe [m]", unit: "m",
      fields: { runout: "99 % of the mobile soil", runout_beyond_toe: "99 % of what passed the toe",
                runout_largest: "farthest point" } },
    { title: "Energies", y: "energy [J]", unit: "J",
      fields: { gravitational_energy: "gravitational", elastic_energy: "elastic" } },
    { title: "Where the energy went", y: "energy [J]", unit: "J",
      fields: { plastic_dissipation: "plastic", friction_dissipation: "floor friction", viscous_dissipation: "viscous",
                energy_numerical: "numerical" } },
    { title: "Work", y: "work [J]", unit: "J", fields: { external_work: "of gravity", internal_work: "of the stresses" } },
];

export const not_drawn = ["step", "stage"]; // counters
export const abscissas = ["time", "t"];

const named = new Set(panels.flatMap((panel) => Object.keys(panel.fields)));
export const is_other = (field) => !named.has(field) && !not_drawn.includes(field) && !abscissas.includes(field);
