# Every style's command line: what must be refused, each bad input in a process of its own; and what must be taken
set(styles_with_keywords stress/contact nematic contact/grain contact/solver energy/ledger dissipation fabric
  contact/surface contact/direction contact/local fluctuation layering velocity/correlation velocity/memory
  wall/contact wall/triangle
  contact/force packing
  displacement/shear press/strain press/wall nve/spheroid gran/insitu)
set(keywords ${CMAKE_CURRENT_SOURCE_DIR}/errors/keywords.py)
foreach(style IN LISTS styles_with_keywords)
  string(REPLACE / - case ${style})
  foreach(way refused taken)
    add_script(${style}-keywords-${way} COMMAND ${keywords} ${case}-${way} 1 LABELS error ${style})
  endforeach()
  add_script(${style}-keywords-refused-every-word COMMAND ${keywords} ${case}-refused-every-word 1 LABELS long ${style})
endforeach()
# Every rank reads the same words in the same way: of three styles every day.
foreach(style IN LISTS styles_with_keywords)
  string(REPLACE / - case ${style})
  set(labels long)
  if(style MATCHES "^(stress/contact|press/strain|gran/insitu)$")
    set(labels error mpi)
  endif()
  add_script(${style}-keywords-refused-on-2-ranks RANKS 2 COMMAND ${keywords} ${case}-refused 2
             LABELS ${labels} ${style})
endforeach()
foreach(style stress/contact velocity/memory press/strain nve/spheroid gran/insitu)
  string(REPLACE / - case ${style})
  add_script(${style}-keywords-refused-on-4-ranks RANKS 4 COMMAND ${keywords} ${case}-refused 4
             LABELS long ${style})
endforeach()

# Right words in surroundings that are not
add_cases(every-style-surroundings errors/surroundings.py LABEL error STYLES ALL CASES
  no-pair-style pair-style-gran memory-before-box atom-style atom-style-changed-later group-deleted compute-deleted
  variable-becomes-nan variable-becomes-infinite box-changed asked-between-runs asked-on-a-step-of-no-one)
add_cases(every-style-surroundings errors/surroundings.py LABEL error STYLES ALL LONG_RANKS 2 CASES
  variable-becomes-nan)
add_cases(gran/insitu-surroundings errors/surroundings.py LABEL error STYLES gran/insitu RANKS 1 LONG_RANKS 2 4 CASES
  words-before-hybrid)
set(of_strain displacement/shear velocity/memory press/strain)
add_cases(displacement/shear+velocity/memory-surroundings errors/surroundings.py LABEL error STYLES ${of_strain} CASES
  strain-fix-deleted named-strain-fix-deleted strain-variable-deleted memory-replaced-by-hand)
add_cases(displacement/shear+velocity/memory-surroundings errors/surroundings.py LABEL error STYLES ${of_strain} RANKS 1
  LONG_RANKS 2 CASES strain-not-set-up)
add_cases(press/strain-surroundings errors/surroundings.py LABEL error STYLES press/strain CASES
  target-variable-deleted)
add_cases(press/strain-surroundings errors/surroundings.py LABEL error STYLES press/strain RANKS 1 LONG_RANKS 2 4 CASES
  variable-becomes-negative)
set(of_records energy/ledger ledger/record grain/record displacement/shear velocity/memory)
add_cases(energy/ledger+displacement/shear+velocity/memory-surroundings errors/surroundings.py LABEL error STYLES
  ${of_records} RANKS 1 LONG_RANKS 2 4 CASES grains-renumbered)
add_cases(energy/ledger+displacement/shear+velocity/memory-surroundings errors/surroundings.py LABEL error
  STYLES ${of_records} RANKS 1 LONG_RANKS 2 CASES grains-renumbered-warned)

add_cases(gran/insitu-refused errors/pair.py LABEL error STYLES gran/insitu run/guard setup/memory
  RANKS 1 LONG_RANKS 2 CASES
  hybrid newton-on setup-twice guard-by-hand memory-by-hand misspelt-model misspelt-setting)
add_cases(gran/insitu-refused errors/pair.py LABEL error STYLES gran/insitu RANKS 1 LONG_RANKS 2 CASES
  small-periodic-box)
add_cases(press/strain-refused errors/press_strain.py LABEL error STYLES press/strain CASES
  target-no-such-variable rate-variable-zero not-periodic-along-axis cylinder-across-the-axis second-fix-deform
  gain-auto-unknown-model gain-auto-unknown-model-of-a-wall)
add_cases(press/strain-refused errors/press_strain.py LABEL error STYLES press/strain RANKS 1 LONG_RANKS 2 CASES
  target-variable-negative orthogonal-box)
add_cases(press/strain-refused errors/press_strain.py LABEL error STYLES press/strain RANKS 1 LONG_RANKS 2 CASES
  wall-on-the-axis)
add_cases(press/wall-refused errors/press_wall.py LABEL error STYLES press/wall RANKS 1 LONG_RANKS 2 CASES second-mover
  grains)
add_cases(press/wall-refused errors/press_wall.py LABEL error STYLES press/wall RANKS 1 LONG_RANKS 2 CASES
  mesh speed box leaves-the-box pair unknown-model variables)
set(recorded displacement/shear grain/record)
add_cases(field-refused errors/field.py LABEL error STYLES field RANKS 1 LONG_RANKS 2 CASES
  numbers too-many-cells quantities bounds kernels rings choices two-dimensions)
add_cases(field-refused errors/field.py LABEL error STYLES field CASES taken)
add_cases(contact/surface-refused errors/measures.py LABEL error STYLES contact/surface CASES
  surface-sphere-among-spheroids surface-boxy)
add_cases(contact/surface-refused errors/measures.py LABEL error STYLES contact/surface RANKS 1 LONG_RANKS 2 CASES
  surface-two-shapes)
add_cases(contact/surface-refused errors/measures.py LABEL error STYLES contact/surface RANKS 1 LONG_RANKS 2 CASES
  surface-triaxial surface-of-spheres)
add_cases(wall/contact-refused errors/walls.py LABEL error STYLES wall/contact wall/triangle RANKS 1 LONG_RANKS 2 CASES
  names)
add_cases(wall/contact-refused errors/walls.py LABEL error STYLES wall/contact CASES gone come-and-gone unknown-losses)
add_cases(velocity/correlation-refused errors/measures.py LABEL error STYLES velocity/correlation CASES
  correlation-mesh-too-fine)
add_cases(velocity/correlation-refused errors/measures.py LABEL error STYLES velocity/correlation RANKS 1 LONG_RANKS 2
  CASES correlation-mesh-not-periodic)
add_cases(velocity/memory-refused errors/measures.py LABEL error STYLES velocity/memory CASES memory-too-much)
add_cases(velocity/memory-refused errors/measures.py LABEL error STYLES velocity/memory RANKS 1 LONG_RANKS 2 CASES
  memory-without-strain)
add_cases(displacement/shear-refused errors/measures.py LABEL error STYLES ${recorded} CASES
  displacement-record-taken displacement-record-gone record-by-hand displacement-strain-not-an-equal-variable
  displacement-strain-no-such-fix displacement-strain-beyond-the-vector displacement-without-strain)
add_cases(displacement/shear-refused errors/measures.py LABEL error STYLES ${recorded} RANKS 1 LONG_RANKS 2 CASES
  displacement-strain-no-such-variable)
add_cases(nve/spheroid-refused errors/spheroid.py LABEL error STYLES nve/spheroid CASES
  spheres triaxial-between-runs implicit-cfd-coupling)
add_cases(nve/spheroid-refused errors/spheroid.py LABEL error STYLES nve/spheroid RANKS 1 2 CASES triaxial-grains)
add_cases(nve/spheroid-refused errors/spheroid.py LABEL error STYLES nve/spheroid RANKS 1 LONG_RANKS 2 CASES
  boxy-about-an-equator triaxial-inserted)
add_cases(surface/ellipsoid-refused errors/ellipsoid.py LABEL error STYLES surface/ellipsoid CASES
  boxy-one-way boxy-grain-under-gran nearly-an-ellipsoid-is-taken wall-of-spheres both-curvatures-of-a-wall
  limit-negative-under-gran misspelt-surface)
add_cases(surface/ellipsoid-refused errors/ellipsoid.py LABEL error STYLES surface/ellipsoid RANKS 1 LONG_RANKS 2 CASES
  boxy-between-runs boxy-created-later spheres both-curvatures limit-negative)
add_cases(surface/ellipsoid-refused errors/ellipsoid.py LABEL error STYLES surface/ellipsoid RANKS 1 LONG_RANKS 2 4
  CASES first-of-two-boxy-grains)
add_cases(surface/ellipsoid-refused errors/ellipsoid.py LABEL error STYLES surface/ellipsoid
  RANKS 1 LONG_RANKS 2 4 CASES boxy-grain boxy-inserted)
add_cases(contact/solver-refused errors/ellipsoid.py LABEL error STYLES contact/solver CASES solver-of-spheres)
add_cases(contact/solver-refused errors/ellipsoid.py LABEL error STYLES contact/solver RANKS 1 LONG_RANKS 2 CASES
  solver-needs-surface-ellipsoid solver-needs-gran-insitu)
add_cases(contact/solver-refused errors/ellipsoid.py LABEL error STYLES contact/solver RANKS 1 LONG_RANKS 2 CASES
  solver-of-a-group)
add_cases(energy/ledger-refused errors/ledger.py LABEL error STYLES energy/ledger ledger/record dissipation CASES
  dissipation-ledger-off needs-gran-insitu cohesion rolling other-integrator box-without-flow box-of-some-grains
  grains-that-grow record-taken record-gone record-by-hand pre-no-at-first time-step-changed)
add_cases(energy/ledger-refused errors/ledger.py LABEL error STYLES energy/ledger ledger/record RANKS 1 2 CASES
  loose-grains)
add_cases(energy/ledger-refused errors/ledger.py LABEL error STYLES energy/ledger ledger/record RANKS 1 LONG_RANKS 2
  CASES restart-without)
add_cases(energy/ledger-refused errors/ledger.py LABEL error STYLES energy/ledger ledger/record
  RANKS 1 LONG_RANKS 2 CASES ledger-off wall-cohesion restart-with)

# The build
add_cases(build-host errors/build.py LABEL error STYLES build CASES folder-without-liggghts source-left-untouched
  styles-are-listed mended-where-needed own-whitelist)
add_cases(build-host errors/build.py LABEL error STYLES build LONG_RANKS 1 CASES root-or-src not-mended-where-right
  configured-twice-rebuilds-nothing missing-whitelist)
add_cases(build-dependencies errors/dependencies.py LABEL error STYLES build LONG_RANKS 1 CASES tar-file
  tar-file-of-something-else elsewhere static-runtime)
add_cases(build-dependencies errors/dependencies.py LABEL error STYLES build CASES no-network all-that-is-missing
  old-compiler without-fftw)
add_cases(build-dependencies errors/dependencies.py LABEL long STYLES build velocity/correlation CASES
  built-without-fftw)
if(NOT FFTW_FOUND)
  add_cases(velocity/correlation-refused errors/measures.py LABEL error STYLES velocity/correlation RANKS 1 LONG_RANKS 2
  CASES mesh-without-fftw)
endif()
add_cases(build-fork errors/hosts.py LABEL error STYLES build CASES all-of-it-at-once)
add_cases(build-fork errors/hosts.py LABEL error STYLES build LONG_RANKS 1 CASES what-is-missing-is-named
  what-was-not-foreseen a-header-that-is-not-there checked-again-when-a-header-changes)
add_cases(build-installed cases/installed.py LABEL error STYLES build CASES links-of-source links-of-installed
  broken-links-are-found program-is-found run-of-installed study-of-installed knows-no-place)
add_cases(build-installed cases/installed.py LABEL error STYLES build LONG_RANKS 1 CASES without-the-link)
add_cases(build-compilers errors/compilers.py LABEL error STYLES build LONG_RANKS 1 CASES configured-without-a-warning)
add_cases(build-compilers errors/compilers.py LABEL long STYLES build CASES
  clang-takes-the-host-as-c++17 every-file-for-this-processor)

# Messages, whoever writes them
add_cases(run/guard-messages errors/messages.py LABEL error STYLES run/guard RANKS 1 LONG_RANKS 2 4 CASES one-rank)
add_cases(run/guard-messages errors/messages.py LABEL error STYLES run/guard RANKS 1 2 CASES all-ranks)
add_cases(run/guard-messages errors/messages.py LABEL error STYLES run/guard RANKS 1 LONG_RANKS 2 CASES no-screen
  screen-in-a-file no-log log-by-a-command once-where-both-are-one when-the-program-starts)
add_cases(run/guard-messages errors/messages.py LABEL error STYLES run/guard CASES second-signal exception)
add_cases(stress/contact-messages errors/messages.py LABEL error
  STYLES stress/contact contact/grain contact/local velocity/memory CASES
  beyond-the-end of-another-kind index-that-is-none name-that-is-none
  names-of-files variable-that-is-none misspelt-style)
add_cases(stress/contact-messages errors/messages.py LABEL error STYLES stress/contact RANKS 1 2 CASES
  only-the-wrong-one)
if(NOT GRAINSCOPE_VTK)
  add_cases(run/guard-messages errors/messages.py LABEL error STYLES run/guard CASES dumps-that-need-vtk)
endif()
add_cases(press/strain-messages errors/messages.py LABEL error STYLES press/strain CASES of-a-fix)

# What is refused where grains, box or surface do not allow it
add_cases(surface/ellipsoid-cohesion errors/ellipsoid.py LABEL error STYLES surface/ellipsoid CASES
  bridge-washino bridge-easo bridge-under-gran bridge-of-spheres-is-taken)
add_cases(surface/ellipsoid-cohesion errors/ellipsoid.py LABEL error STYLES surface/ellipsoid RANKS 1 LONG_RANKS 2 CASES
  bridge-of-one-spheroid)
add_cases(superquadric-data-file-refused errors/data_files.py LABEL error STYLES superquadric CASES
  columns-of-a-sphere three-numbers-of-a-quaternion-and-images lines-of-several-lengths an-empty-line
  id-zero id-no-number type-too-large density-zero shape-negative shape-not-finite blockiness-below-2 place-no-number
  quaternion-not-finite image-out-of-range image-no-whole-number velocity-of-three velocity-not-finite
  write-own-inertia write-own-radius write-disk-full)
add_cases(superquadric-data-file-refused errors/data_files.py LABEL error STYLES superquadric RANKS 1 2 CASES
  a-column-too-few)
add_cases(superquadric-data-file-refused errors/data_files.py LABEL error STYLES superquadric RANKS 1 LONG_RANKS 2 CASES
  quaternion-zero)
add_cases(superquadric-data-file-refused errors/data_files.py LABEL error STYLES superquadric LONG_RANKS 2 CASES
  write-own-mass)
add_cases(gran/insitu-refused errors/pair.py LABEL error STYLES gran/insitu CASES
  superquadrics-with-the-surface-of-spheres boxy-grains-without-a-surface wall-without-a-surface
  superquadrics-without-a-surface-under-gran synchronized-cohesion synchronized-rolling synchronized-without-friction
  synchronized-surface synchronized-normal synchronized-under-gran synchronized-restart restart-of-other-columns
  units)
add_cases(gran/insitu-refused errors/pair.py LABEL error STYLES gran/insitu wall/gran CASES
  synchronized-wall synchronized-wall-misspelt)
add_cases(gran/insitu-refused errors/pair.py LABEL error STYLES gran/insitu RANKS 1 LONG_RANKS 2 CASES
  superquadrics-without-a-surface)
add_cases(displacement/shear-faces cases/moving_faces.py LABEL error STYLES displacement/shear CASES
  remap-none deform-of-some)
add_cases(layering+velocity/correlation-not-finite errors/not_finite.py LABEL error STYLES layering fluctuation
  velocity/memory velocity/correlation contact/direction contact/surface RANKS 1 LONG_RANKS 2 CASES layering
  correlation-mesh)
add_cases(layering+velocity/correlation-not-finite errors/not_finite.py LABEL error
  STYLES layering fluctuation velocity/memory velocity/correlation contact/direction contact/surface contact/force
  packing CASES
  fluctuation-profile fluctuation-layers memory-layers correlation contact-direction contact-surface
  contact-surface-ellipsoid contact-force packing)

# Restart files of other versions
set(states run/guard setup/memory grain/record ledger/record press/strain press/wall wall/gran)
foreach(style IN LISTS states)
  add_cases(read_restart errors/restart_versions.py LABEL error STYLES read_restart ${style} CASES
    ${style}-version ${style}-size ${style}-without-a-version)
endforeach()
add_cases(read_restart errors/restart_versions.py LABEL error STYLES read_restart ${states} RANKS 1 2 CASES
  same-file-is-read)
add_cases(read_restart errors/restart_versions.py LABEL error STYLES read_restart ${states} RANKS 1 LONG_RANKS 2 CASES
  former-seal not-by-an-input-script)

# Restart files with walls: other models and settings, other IDs
foreach(kind primitive mesh)
  add_cases(wall/gran-restart errors/restart_walls.py LABEL error STYLES wall/gran read_restart CASES
    ${kind}-other-models ${kind}-other-time-level ${kind}-without-the-time-level ${kind}-without-the-ledger
    ${kind}-of-liggghts ${kind}-of-the-other-surface ${kind}-of-another-id)
endforeach()
add_cases(wall/gran-restart errors/restart_walls.py LABEL error STYLES wall/gran read_restart LONG_RANKS 2 CASES
  primitive-other-models mesh-of-another-id)
add_cases(read_restart errors/restart_walls.py LABEL error STYLES read_restart press/strain displacement/shear
  energy/ledger RANKS 1 LONG_RANKS 2 CASES state-of-another-id)

# Outputs have names
add_cases(outputs-refused errors/outputs.py LABEL error STYLES outputs CASES
  no-words other-keyword surplus-word two-prefixes no-prefix prefix-with-a-slash prefix-with-a-dash
  empty-prefix misspelt nothing-like-it host-compute host-fix compute-and-fix before-the-box clash-equal
  clash-string clash-index clash-atom compute-that-is-gone)
add_cases(outputs-refused errors/outputs.py LABEL error STYLES outputs RANKS 2 CASES misspelt)
add_cases(outputs-refused errors/outputs.py LABEL error STYLES outputs LONG_RANKS 2 CASES clash-equal)

# Two dimensions: what has to do with z, superquadrics, grains out of the plane, walls that do not stand on it
add_cases(every-style-two-dimensions-refused errors/two_dimensions.py LABEL error STYLES ALL
  CASES keywords superquadrics)
add_cases(gran/insitu-two-dimensions-refused errors/two_dimensions.py LABEL error STYLES gran/insitu RANKS 1 LONG_RANKS
  2 4 CASES out-of-plane small-box)
add_cases(wall/gran+wall/triangle-two-dimensions-refused errors/two_dimensions.py LABEL error STYLES wall/gran
  wall/triangle RANKS 1 LONG_RANKS 2 CASES walls mesh-walls)
