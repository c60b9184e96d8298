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
