add_cases(error errors/pair.py LABEL error RANKS 1 2 CASES
  hybrid misspelt-model misspelt-setting small-periodic-box stress-contact-needs-gran-insitu dissipation-needs-gran-insitu
  contact-local-needs-gran-insitu)
add_cases(error errors/computes.py LABEL error RANKS 1 2 CASES
  stress-contact-takes-no-keywords nematic-takes-no-keywords dissipation-unknown-keyword dissipation-mode dissipation-mode-missing
  contact-local-column stress-contact-between-runs dissipation-between-runs)
