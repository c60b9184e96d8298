"""What is measured in runs of examples/simple_shear: names of means and curves, with units and meanings."""

# Name of each mean, its unit, and what it is. Powers are over W0 = rate x target pressure x volume.
SERIES = {
    "P": ("P_target", "pressure -sigma_yy"),
    "mu_eff": ("-", "sigma_xy/P"),
    "phi": ("-", "solid fraction"),
    "Z": ("-", "coordination, 2 contacts/grains"),
    "sliding": ("-", "share of sliding contacts"),
    "W_shear": ("W0", "power put in by shear"),
    "W_box": ("W0", "power put in by the moving box"),
    "W_n": ("W0", "power lost to normal damping, from the velocities at the ends of steps"),
    "W_t": ("W0", "power lost to friction, from the slip of the springs"),
    "W_rest": ("W0", "power put in less power lost"),
    "S2": ("-", "nematic order"),
    "theta_x": ("deg", "mean angle of the long axes to the flow"),
    "spin": ("-", "-2 <omega_z>/rate"),
    "overlap_mean": ("d_eq", "mean overlap"),
    "overlap_max": ("d_eq", "largest overlap"),
    "kappa": ("-", "stiffness number"),
}
ALWAYS = {"I_reached": ("-", "inertial number of the mean pressure"), "L_y": ("d_eq", "mean height of the box")}
MEASURED = {
    "instant_n": (
        "W0",
        "power lost to normal damping, sum of damping force x velocity at the force evaluation (Eq. 4)",
    ),
    "instant_t": (
        "W0",
        "power lost to friction, sum over sliding contacts of force x velocity at the force evaluation (Eq. 4)",
    ),
    **{
        f"{part}_{c}": ("P", f"sigma_{c} of the {kind} contact forces, tension positive")
        for part, kind in (("n", "normal"), ("t", "tangential"))
        for c in ("xx", "yy", "zz", "xy")
    },
    "N1": ("P", "sigma_xx - sigma_yy"),
    "N2": ("P", "sigma_yy - sigma_zz"),
    **{f"F_{c}": ("-", f"fabric, component {c}") for c in ("xx", "yy", "zz", "xy", "xz", "yz")},
    "fabric_deviator": ("-", "sqrt(3/2 F':F') of the mean fabric"),
    "dv_x/dv_y": ("-", "velocity fluctuations, flow over gradient"),
    "dv_x/dv_z": ("-", "flow over vorticity"),
    "E_rot/E_tr": ("-", "fluctuating energy, rotation over translation"),
    "lever": ("-", "velocity fluctuation over rate x d_eq"),
    "spin_fluctuation": ("-", "fluctuation of the angular velocity over the rate"),
    "idle": ("%", "grains with fewer than two contacts"),
    "layering": ("-", "largest correlation of the density beyond half a diameter"),
    "l_vy": ("d_eq", "correlation length of dv_y"),
    "l_wz": ("d_eq", "correlation length of dw_z"),
    "D_y": ("rate d_eq2", "diffusion coefficient along the gradient"),
    "D_z": ("rate d_eq2", "diffusion coefficient along the vorticity"),
}
FORCES = {"F_n": ("P A_p", "mean normal force"), "F_t": ("P A_p", "mean tangential force")}
# Name of each curve: its columns as above, the first of them what it runs over
CURVES = {
    "correlation": {"r": ("d_eq", "distance"), "vy": ("-", "correlation of dv_y"), "wz": ("-", "correlation of dw_z")},
    "memory": {"lag": ("-", "strain between"), "vy": ("-", "correlation of a grain's dv_y with itself")},
    "layering": {
        "y": ("d_eq", "distance along the gradient"),
        "C": ("-", "correlation of the density of centres over that at 0"),
    },
    "surface": {
        "psi": ("rad", "angle between a contact and the grain's symmetry axis"),
        "density": ("-", "contacts rho_s A_p"),
        "inhomogeneity": ("-", "of the dissipated power"),
        "printed density": ("-", "over the area element that the paper prints"),
        "printed inhomogeneity": ("-", "over the area element that the paper prints"),
        **FORCES,
        "mobilisation": ("-", "mean |F_t|/(mu F_n)"),
        "sliding": ("-", "share of sliding contacts"),
    },
    "direction": {
        "beta": ("rad", "angle of a contact normal to the flow"),
        "density": ("1/rad", "of contact normals"),
        **FORCES,
    },
    "displacement": {
        "strain": ("-", "since the run's averages began"),
        "y2": ("d_eq2", "mean square displacement along the gradient"),
        "z2": ("d_eq2", "mean square displacement along the vorticity"),
    },
}
