add_cases(error-pair errors/pair.py LABEL error RANKS 1 2 CASES
  hybrid newton-on misspelt-model misspelt-setting small-periodic-box stress-contact-needs-gran-insitu dissipation-needs-gran-insitu
  contact-local-needs-gran-insitu)
add_cases(error-compute errors/computes.py LABEL error RANKS 1 2 CASES
  stress-contact-takes-no-keywords nematic-takes-no-keywords dissipation-unknown-keyword dissipation-mode dissipation-mode-missing
  contact-local-column stress-contact-between-runs dissipation-between-runs)
add_cases(error-press-strain errors/press_strain.py LABEL error RANKS 1 CASES
  axis axis-missing target target-not-a-number target-missing target-no-such-variable target-variable-negative shear shear-without-rate
  rate-zero rate-infinite rate-variable-zero every every-missing every-twice every-without-shear every-time every-step gain limit maxrate
  momentum kinetic keyword-twice unknown-keyword value-missing orthogonal-box not-periodic-along-axis wall-on-the-axis cylinder-across-the-axis
  second-fix-deform needs-gran-insitu)
add_cases(error-press-strain errors/press_strain.py LABEL error RANKS 2 CASES
  axis target-variable-negative rate-zero every-without-shear orthogonal-box wall-on-the-axis needs-gran-insitu)
add_cases(build errors/build.py LABEL error CASES
  folder-without-liggghts root-or-src source-left-untouched styles-are-listed mended-where-needed not-mended-where-right
  configured-twice-rebuilds-nothing own-whitelist missing-whitelist)
add_cases(error-measures errors/measures.py LABEL error RANKS 1 CASES
  fabric-keyword fabric-plane fabric-plane-missing fabric-twice fabric-between-runs surface-bins-too-many surface-keyword surface-bins surface-bins-fraction
  surface-bins-nan surface-bins-missing surface-angle surface-axis surface-sphere-among-spheroids surface-boxy
  surface-needs-gran-insitu direction-keyword direction-bins-odd direction-bins-zero direction-bins-missing direction-plane
  grain-takes-no-keywords grain-needs-gran-insitu fluctuation-keyword fluctuation-layers fluctuation-diameter
  fluctuation-diameter-nan fluctuation-plane fluctuation-flow fluctuation-flow-missing fluctuation-flow-rate
  fluctuation-flow-rate-infinite fluctuation-flow-layers layering-keyword layering-axis layering-layers-odd
  layering-layers-missing correlation-keyword correlation-component correlation-component-missing correlation-bins
  correlation-range correlation-method correlation-mesh correlation-mesh-not-asked correlation-mesh-too-fine correlation-average
  correlation-flow correlation-plane memory-keyword memory-component memory-every memory-every-nan memory-lags memory-lags-missing
  memory-flow memory-plane displacement-keyword displacement-start displacement-start-nan displacement-record-taken displacement-record-gone record-by-hand
  memory-too-much displacement-strain
  displacement-strain-of-a-fix displacement-strain-element displacement-strain-missing displacement-strain-not-an-equal-variable
  displacement-strain-no-such-fix displacement-strain-beyond-the-vector displacement-without-strain)
add_cases(error-measures errors/measures.py LABEL error RANKS 1 2 CASES
  surface-two-shapes surface-triaxial surface-of-spheres correlation-mesh-not-periodic memory-without-strain
  displacement-strain-no-such-variable fabric-needs-gran-insitu)
add_cases(error-spheroid errors/spheroid.py LABEL error RANKS 1 CASES
  takes-no-keywords spheres triaxial-between-runs implicit-cfd-coupling)
add_cases(error-spheroid errors/spheroid.py LABEL error RANKS 1 2 CASES triaxial-grains boxy-about-an-equator triaxial-inserted)
add_cases(error-ellipsoid errors/ellipsoid.py LABEL error RANKS 1 CASES
  boxy-one-way boxy-grain-under-gran nearly-an-ellipsoid-is-taken wall-of-spheres both-curvatures-of-a-wall limit-negative-under-gran
  misspelt-surface solver-takes-no-keywords solver-of-spheres)
add_cases(error-ellipsoid errors/ellipsoid.py LABEL error RANKS 1 2 CASES
  boxy-between-runs boxy-created-later spheres both-curvatures limit-negative solver-of-a-group solver-needs-surface-ellipsoid
  solver-needs-gran-insitu)
add_cases(error-ellipsoid errors/ellipsoid.py LABEL error RANKS 1 2 4 CASES boxy-grain first-of-two-boxy-grains boxy-inserted)
add_cases(error-ledger errors/ledger.py LABEL error RANKS 1 CASES
  word word-missing word-twice takes-no-keywords ledger-off dissipation-ledger-off needs-gran-insitu cohesion rolling loose-grains
  other-integrator box-without-flow box-of-some-grains record-taken record-gone record-by-hand grains-inserted restart-without restart-with
  pre-no-at-first time-step-changed)
add_cases(error-ledger errors/ledger.py LABEL error RANKS 2 CASES ledger-off loose-grains grains-inserted restart-without restart-with)
