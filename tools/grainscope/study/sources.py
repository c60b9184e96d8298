"""Where each column of a study's tables is defined: an equation, figure or section of Bilotto, Trulsson & Molinari
(2025), or the page or deck of this project that defines it."""

DECK = "examples/simple_shear/in.simple_shear"
STUDY = "doc/howto_study.md"
COST = "doc/cost.md"
STRESS = "Eq. (2)"
POWERS_OF_PAPER = "Eq. (4)"
FABRIC = "Eq. (9), Fig. 10"
FLUCTUATION = "Sec. III B, Figs. 5, 6"
CORRELATION = "Eq. (7), Fig. 9"
DIFFUSION = "App. E, Fig. 16"
CONTACT_PAGE = "doc/compute_stress_contact.md"
LOSSES = "App. B; doc/compute_dissipation.md, mode step"

OF_COLUMN = {
    **dict.fromkeys(("run", "state", "steady", "flagged"), STUDY),
    **dict.fromkeys(("alpha", "mu", "I", "e", "N", "d_eq"), "Sec. II"),
    **dict.fromkeys(("seed", "strain"), DECK),
    **dict.fromkeys(("steps", "grain_step", "core_time", "memory", "bytes"), COST),
    "P": STRESS,
    "mu_eff": f"{STRESS}, Fig. 7",
    "phi": "Sec. II, Fig. 7",
    "Z": "Fig. 7",
    **dict.fromkeys(("sliding", "overlap_mean", "overlap_max", "kappa"), CONTACT_PAGE),
    **dict.fromkeys(("W_shear", "W_box", "W_rest"), DECK),
    **dict.fromkeys(("W_n", "W_t"), LOSSES),
    **dict.fromkeys(("S2", "theta_x"), "Eq. (3), Fig. 2"),
    "spin": "Fig. 2",
    "I_reached": "Sec. II",
    "L_y": "Sec. II",
    **dict.fromkeys(("instant_n", "instant_t"), POWERS_OF_PAPER),
    **{f"{part}_{c}": f"{STRESS}, App. G, Fig. 18" for part in "nt" for c in ("xx", "yy", "zz", "xy")},
    **dict.fromkeys(("N1", "N2"), f"{STRESS}, App. D, Fig. 15"),
    **{f"F_{c}": FABRIC for c in ("xx", "yy", "zz", "xy", "xz", "yz")},
    "fabric_deviator": FABRIC,
    **dict.fromkeys(("dv_x/dv_y", "dv_x/dv_z", "E_rot/E_tr", "lever", "spin_fluctuation"), FLUCTUATION),
    "idle": "doc/compute_contact_grain.md",
    "layering": "Sec. III A",
    **dict.fromkeys(("l_vy", "l_wz"), CORRELATION),
    **dict.fromkeys(("D_y", "D_z"), DIFFUSION),
}
OF_CURVE = {
    "correlation": CORRELATION,
    "memory": "Eq. (7), in time instead of space",
    "layering": "Sec. III A",
    "surface": "Eq. (10), Fig. 11",
    "direction": "Eq. (F1), Fig. 17",
    "displacement": DIFFUSION,
}
