add_cases(pair-bitwise-equal cases/pair_bitwise.py LABEL case RANKS 1 2 CASES
  spheres spheres-as-superquadrics spheroid-0.33 spheroid-1.5 spheroid-3 polydisperse two-types)
add_cases(pair-bitwise-equal cases/pair_bitwise.py LABEL case RANKS 1 CASES
  tangential-off tangential-no-history rolling-cdt hooke tangential-damping-off gaussian-curvature limit-force
  uncompiled-combination boxy-grains)
add_cases(pair cases/pair_host.py LABEL case RANKS 1 2 CASES
  pair-local-output-does-not-disturb contact-local-output-does-not-disturb restart-continues restart-of-spheres-continues
  clear-and-begin-again pair-style-again stale-springs-warned-once virial-of-spheroids host-deck-with-walls)
add_cases(pair cases/pair_host.py LABEL case RANKS 1 CASES
  stale-springs-cured-no-warning no-springs-no-warning check-timestep-gran virial-of-plain-gran-is-wrong)
