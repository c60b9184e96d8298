add_cases(keywords errors/keywords.py LABEL error CASES
  stress-contact-refused nematic-refused contact-grain-refused contact-solver-refused energy-ledger-refused dissipation-refused fabric-refused
  contact-surface-refused contact-direction-refused contact-local-refused fluctuation-refused layering-refused velocity-correlation-refused
  velocity-memory-refused displacement-shear-refused press-strain-refused nve-spheroid-refused gran-insitu-refused
  stress-contact-taken nematic-taken contact-grain-taken contact-solver-taken energy-ledger-taken dissipation-taken fabric-taken
  contact-surface-taken contact-direction-taken contact-local-taken fluctuation-taken layering-taken velocity-correlation-taken
  velocity-memory-taken displacement-shear-taken press-strain-taken nve-spheroid-taken gran-insitu-taken)
add_cases(keywords errors/keywords.py LABEL error RANKS 2 CASES
  stress-contact-refused nematic-refused contact-grain-refused contact-solver-refused energy-ledger-refused dissipation-refused fabric-refused
  contact-surface-refused contact-direction-refused contact-local-refused fluctuation-refused layering-refused velocity-correlation-refused
  velocity-memory-refused displacement-shear-refused press-strain-refused nve-spheroid-refused gran-insitu-refused)
add_cases(keywords errors/keywords.py LABEL error RANKS 4 CASES
  stress-contact-refused velocity-memory-refused press-strain-refused nve-spheroid-refused gran-insitu-refused)
add_cases(surroundings errors/surroundings.py LABEL error CASES
  no-pair-style pair-style-gran words-before-hybrid memory-before-box atom-style atom-style-changed-later group-deleted compute-deleted
  strain-fix-deleted named-strain-fix-deleted strain-variable-deleted target-variable-deleted variable-becomes-nan variable-becomes-infinite
  variable-becomes-negative box-changed grains-renumbered grains-renumbered-warned memory-replaced-by-hand asked-between-runs
  strain-not-set-up)
add_cases(surroundings errors/surroundings.py LABEL error RANKS 2 CASES
  words-before-hybrid variable-becomes-nan variable-becomes-negative grains-renumbered grains-renumbered-warned strain-not-set-up)
add_cases(surroundings errors/surroundings.py LABEL error RANKS 4 CASES words-before-hybrid grains-renumbered variable-becomes-negative)
add_cases(error-pair errors/pair.py LABEL error RANKS 1 2 CASES hybrid newton-on setup-twice guard-by-hand memory-by-hand misspelt-model misspelt-setting small-periodic-box)
add_cases(error-press-strain errors/press_strain.py LABEL error RANKS 1 CASES
  target-no-such-variable target-variable-negative rate-variable-zero orthogonal-box not-periodic-along-axis wall-on-the-axis
  cylinder-across-the-axis second-fix-deform)
add_cases(error-press-strain errors/press_strain.py LABEL error RANKS 2 CASES target-variable-negative orthogonal-box wall-on-the-axis)
add_cases(build errors/build.py LABEL error CASES
  folder-without-liggghts root-or-src source-left-untouched styles-are-listed mended-where-needed not-mended-where-right
  configured-twice-rebuilds-nothing own-whitelist missing-whitelist)
add_cases(error-measures errors/measures.py LABEL error RANKS 1 CASES
  surface-sphere-among-spheroids surface-boxy correlation-mesh-too-fine displacement-record-taken displacement-record-gone record-by-hand
  memory-too-much displacement-strain-not-an-equal-variable displacement-strain-no-such-fix displacement-strain-beyond-the-vector
  displacement-without-strain)
add_cases(error-measures errors/measures.py LABEL error RANKS 1 2 CASES
  surface-two-shapes surface-triaxial surface-of-spheres correlation-mesh-not-periodic memory-without-strain
  displacement-strain-no-such-variable)
add_cases(error-spheroid errors/spheroid.py LABEL error RANKS 1 CASES
  spheres triaxial-between-runs implicit-cfd-coupling)
add_cases(error-spheroid errors/spheroid.py LABEL error RANKS 1 2 CASES triaxial-grains boxy-about-an-equator triaxial-inserted)
add_cases(error-ellipsoid errors/ellipsoid.py LABEL error RANKS 1 CASES
  boxy-one-way boxy-grain-under-gran nearly-an-ellipsoid-is-taken wall-of-spheres both-curvatures-of-a-wall limit-negative-under-gran
  misspelt-surface solver-of-spheres)
add_cases(error-ellipsoid errors/ellipsoid.py LABEL error RANKS 1 2 CASES
  boxy-between-runs boxy-created-later spheres both-curvatures limit-negative solver-of-a-group solver-needs-surface-ellipsoid
  solver-needs-gran-insitu)
add_cases(error-ellipsoid errors/ellipsoid.py LABEL error RANKS 1 2 4 CASES boxy-grain first-of-two-boxy-grains boxy-inserted)
add_cases(error-ledger errors/ledger.py LABEL error RANKS 1 CASES
  ledger-off dissipation-ledger-off needs-gran-insitu cohesion rolling loose-grains
  other-integrator box-without-flow box-of-some-grains record-taken record-gone record-by-hand grains-inserted restart-without restart-with
  pre-no-at-first time-step-changed)
add_cases(error-ledger errors/ledger.py LABEL error RANKS 2 CASES ledger-off loose-grains grains-inserted restart-without restart-with)
add_cases(build-fork errors/hosts.py LABEL error STYLES build CASES
  what-is-missing-is-named all-of-it-at-once what-was-not-foreseen a-header-that-is-not-there checked-again-when-a-header-changes)
