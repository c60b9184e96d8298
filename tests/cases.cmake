add_cases(pair-bitwise-equal cases/pair_bitwise.py LABEL case RANKS 1 2 CASES
  spheres spheres-as-superquadrics spheroid-0.33 spheroid-1.5 spheroid-3 polydisperse two-types)
add_cases(pair-bitwise-equal cases/pair_bitwise.py LABEL case RANKS 1 CASES
  tangential-off tangential-no-history rolling-cdt hooke tangential-damping-off gaussian-curvature limit-force
  uncompiled-combination boxy-grains)
