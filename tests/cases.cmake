# gran/insitu: the motion of pair_style gran, LIGGGHTS around it
add_cases(gran/insitu-bitwise-equal cases/pair_bitwise.py LABEL case STYLES gran/insitu RANKS 1 LONG_RANKS 2 CASES
  spheres polydisperse two-types)
add_cases(gran/insitu-bitwise-equal cases/pair_bitwise.py LABEL case STYLES gran/insitu LONG_RANKS 1 2 CASES
  spheres-as-superquadrics spheroid-0.33 spheroid-3)
add_cases(gran/insitu-bitwise-equal cases/pair_bitwise.py LABEL case STYLES gran/insitu RANKS 1 2 CASES spheroid-1.5)
add_cases(gran/insitu-bitwise-equal cases/pair_bitwise.py LABEL case STYLES gran/insitu LONG_RANKS 1 CASES
  tangential-off limit-force)
add_cases(gran/insitu-bitwise-equal cases/pair_bitwise.py LABEL case STYLES gran/insitu CASES tangential-no-history
  rolling-cdt hooke tangential-damping-off gaussian-curvature uncompiled-combination boxy-grains)
add_cases(gran/insitu-spheres cases/sphere_bitwise.py LABEL case STYLES gran/insitu RANKS 1 LONG_RANKS 2 4 CASES hertz)
add_cases(gran/insitu-spheres cases/sphere_bitwise.py LABEL case STYLES gran/insitu RANKS 1 LONG_RANKS 2 4 CASES
  hooke tangential-no-history frozen-of-two-types polydisperse settling-between-walls bridges-washino
  narrow-contact-distance)
add_cases(gran/insitu-spheres cases/sphere_bitwise.py LABEL case STYLES gran/insitu CASES hooke-two-sevenths
  hertz-stiffness hooke-stiffness hooke-stiffness-absolute tangential-off tangential-no-history-of-hooke
  tangential-damping-off limit-force two-types frozen rolling-cdt rolling-epsd2 cohesion-sjkr ledger bridges-easo
  types-that-no-grain-has spheroids-of-hertz-stiffness spheroids-of-hertz-stiffness-without-friction)
add_cases(gran/insitu-spheres cases/sphere_bitwise.py LABEL case STYLES gran/insitu LONG_RANKS 1 CASES
  types-that-no-spheroid-has spheroids-of-hooke-stiffness)
add_cases(gran/insitu-host cases/pair_host.py LABEL case STYLES gran/insitu RANKS 1 LONG_RANKS 2 CASES
  pair-local-output-does-not-disturb restart-of-spheres-continues clear-and-begin-again pair-style-again
  sinks-come-and-go virial-of-spheroids)
add_cases(gran/insitu-host cases/pair_host.py LABEL case STYLES gran/insitu RANKS 1 LONG_RANKS 2 CASES
  restart-continues stale-springs-warned-once host-deck-with-walls)
add_cases(gran/insitu-host cases/pair_host.py LABEL case STYLES gran/insitu CASES stale-springs-beside-rigid-bodies)
add_cases(gran/insitu-host cases/pair_host.py LABEL case STYLES gran/insitu CASES
  stale-springs-cured-no-warning no-stale-springs-of-spheres no-stale-springs-of-spheroids
  no-stale-springs-of-ellipsoids every-way-to-ask spin-of-frictionless-spheres no-springs-no-warning
  check-timestep-gran virial-of-plain-gran-is-wrong)
add_cases(contact/local+gran/insitu-host cases/pair_host.py LABEL case STYLES contact/local gran/insitu
  RANKS 1 LONG_RANKS 2 CASES contact-local-output-does-not-disturb)
add_cases(gran/insitu+stress/contact-host-tally cases/ranks.py LABEL case STYLES gran/insitu stress/contact
  RANKS 1 LONG_RANKS 2 CASES stress-atom-of-spheres stress-atom-of-spheroids)
add_cases(gran/insitu-range cases/ranges.py LABEL case STYLES gran/insitu RANKS 1 LONG_RANKS 2 CASES
  time-step time-step-in-short-runs time-step-at-walls time-step-unseen quiet unstable-from-the-start)

# stress/contact, dissipation, nematic, contact/local against the oracle and a contact law of its own
set(first_measures stress/contact dissipation nematic contact/local)
add_cases(stress/contact+dissipation+nematic-oracle cases/measures_against_oracle.py LABEL case
  STYLES ${first_measures} RANKS 1 LONG_RANKS 2 CASES spheroid-1.5)
add_cases(stress/contact+dissipation+nematic-oracle cases/measures_against_oracle.py LABEL case
  STYLES ${first_measures} RANKS 1 LONG_RANKS 2 CASES
  spheres spheres-in-the-open spheroid-1.5-in-the-open spheres-through-a-flip spheroids-through-a-flip
  walls)
add_cases(stress/contact+dissipation+nematic-oracle cases/measures_against_oracle.py LABEL case
  STYLES ${first_measures} CASES
  spheroid-0.33-in-the-open spheroid-3-in-the-open polydisperse two-types frictionless no-history subgroup
  group-of-one)
add_cases(stress/contact+dissipation+nematic-same cases/ranks.py LABEL case STYLES ${first_measures}
  RANKS 2 LONG_RANKS 4 CASES spheroids)
add_cases(stress/contact+dissipation+nematic-same cases/ranks.py LABEL case STYLES ${first_measures}
  LONG_RANKS 2 4 CASES spheres oblate-grains subgroup)
add_cases(stress/contact+dissipation+nematic-same cases/ranks.py LABEL case STYLES ${first_measures} RANKS 4 CASES
  empty-ranks empty-group)
add_cases(stress/contact+dissipation+nematic-same cases/ranks.py LABEL case STYLES ${first_measures} surface/ellipsoid
  LONG_RANKS 4 CASES ellipsoids-0.33 ellipsoids-polydisperse)
add_cases(stress/contact+dissipation+nematic-same cases/ranks.py LABEL case STYLES ${first_measures} surface/ellipsoid
  LONG_RANKS 2 4 CASES ellipsoids-1.5)
add_cases(stress/contact+dissipation+nematic-same cases/ranks.py LABEL case STYLES ${first_measures} surface/ellipsoid
  LONG_RANKS 2 4 CASES ellipsoids-3)
# measures of contacts that are worked out four at a time, against one by one
add_cases(stress/contact+dissipation-lanes cases/lane_measures.py LABEL case STYLES ${first_measures} gran/insitu
  LONG_RANKS 1 2 CASES spheres)
add_cases(stress/contact+dissipation-lanes cases/lane_measures.py LABEL case STYLES ${first_measures} gran/insitu
  surface/ellipsoid LONG_RANKS 1 2 CASES spheroid-1.5)
add_cases(stress/contact+dissipation-lanes cases/lane_measures.py LABEL case STYLES ${first_measures} gran/insitu
  surface/ellipsoid RANKS 1 LONG_RANKS 2 CASES mixed-shapes)
add_cases(stress/contact+dissipation-lanes cases/lane_measures.py LABEL case STYLES ${first_measures} gran/insitu
  LONG_RANKS 1 CASES spheres-of-five-sizes spheres-hooke spheres-limit-force)
add_cases(stress/contact+dissipation-lanes cases/lane_measures.py LABEL case STYLES ${first_measures} gran/insitu CASES
  spheres-of-two-types spheres-no-history spheres-without-friction)
add_cases(stress/contact+dissipation-lanes cases/lane_measures.py LABEL case STYLES ${first_measures} gran/insitu
  surface/ellipsoid LONG_RANKS 1 CASES round-ellipsoids spheroid-1.5-without-friction spheroid-1.5-limit-force)
add_cases(stress/contact+dissipation-lanes cases/lane_measures.py LABEL case STYLES ${first_measures} gran/insitu
  surface/ellipsoid CASES spheroid-0.5 spheroid-1.5-of-two-types spheroid-1.5-hooke spheroid-1.5-no-history)
add_cases(stress/contact-range cases/ranges.py LABEL case STYLES stress/contact RANKS 1 LONG_RANKS 2 CASES kappa)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation LONG_RANKS 1
  CASES history-undamped no-history synchronized synchronized-no-history)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation CASES
  frictionless slippery limit-force synchronized-two-types)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation RANKS 1
  LONG_RANKS 2 CASES
  history)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation
  RANKS 1 LONG_RANKS 2 CASES two-types)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation press/strain
  RANKS 1 LONG_RANKS 2 CASES under-pressure-control)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation press/strain
  LONG_RANKS 1 2 CASES sheared-backward)
add_cases(contact/local+surface/ellipsoid-rows cases/ellipsoid_rows.py LABEL case STYLES contact/local surface/ellipsoid
  LONG_RANKS 1 CASES spheroid-0.33 spheroid-3 ellipsoid-0.33 ellipsoid-3)
add_cases(contact/local+surface/ellipsoid-rows cases/ellipsoid_rows.py LABEL case
  STYLES contact/local surface/ellipsoid RANKS 1 LONG_RANKS 2 CASES spheroid-1.5)
add_cases(contact/local+surface/ellipsoid-rows cases/ellipsoid_rows.py LABEL case
  STYLES contact/local surface/ellipsoid RANKS 2 CASES ellipsoid-1.5)
add_cases(nematic-order cases/nematic.py LABEL case STYLES nematic CASES
  two-of-four-along-z three-of-four-along-z all-aligned isotropic mean-angle mean-angle-is-of-lines oblate-angle
  spheres-have-no-order spheres-do-not-dilute longest-of-three-axes axis-along-body-x mean-spin)
add_cases(nematic-order cases/nematic.py LABEL case STYLES nematic RANKS 2 LONG_RANKS 4 CASES three-of-four-along-z)
add_cases(nematic-order cases/nematic.py LABEL case STYLES nematic LONG_RANKS 2 4 CASES two-of-four-along-z)
add_cases(dissipation-collision cases/collisions.py LABEL case STYLES dissipation CASES
  head-on-spheres-e-0.1 head-on-spheres-e-0.5 head-on-spheres-e-0.9 head-on-prolate-e-0.1 head-on-prolate-e-0.5
  head-on-prolate-e-0.9 head-on-oblate-e-0.1 head-on-oblate-e-0.5 head-on-oblate-e-0.9 oblique-spheres oblique-prolate
  single-contact)
add_cases(dissipation-collision cases/collisions.py LABEL case STYLES dissipation LONG_RANKS 2 CASES oblique-prolate)
add_cases(dissipation-collision cases/collisions.py LABEL case STYLES dissipation LONG_RANKS 2 CASES
  head-on-prolate-e-0.5)

# fabric, contact/surface, contact/direction, contact/grain
set(contact_measures fabric contact/surface contact/direction contact/grain)
add_cases(fabric+contact/surface+contact/direction+contact/grain-oracle cases/contact_measures.py LABEL case STYLES
  ${contact_measures} CASES spheres-mu-0 spheres-mu-10 spheres-polydisperse spheroid-0.33-in-the-open
  spheroid-1-in-the-open spheroid-1.5-mu-0 spheroid-0.33 polydisperse two-types with-tangential-damping no-history
  tilted-backward subgroup group-of-one walls units-cgs)
add_cases(fabric+contact/surface+contact/direction+contact/grain-oracle cases/contact_measures.py LABEL case STYLES
  ${contact_measures} LONG_RANKS 1 CASES spheroid-0.67-in-the-open spheroid-3-in-the-open spheroid-1.5-mu-10
  axis-along-body-x)
add_cases(fabric+contact/surface+contact/direction+contact/grain-oracle cases/contact_measures.py LABEL case
  STYLES ${contact_measures} RANKS 1 2 CASES spheroid-1.5)
add_cases(fabric+contact/surface+contact/direction+contact/grain-oracle cases/contact_measures.py LABEL case
  STYLES ${contact_measures} RANKS 1 LONG_RANKS 2 CASES
  spheres spheroid-1.5-in-the-open spheres-through-a-flip spheroids-through-a-flip under-pressure-control)
add_cases(fabric+contact/surface+contact/direction+contact/grain-analytic cases/contact_analytic.py LABEL case
  STYLES ${contact_measures} CASES
  three-of-four-along-z three-of-four-along-z-in-xz two-of-four-along-z one-of-four-less-along-x all-along-one
  angle-is-of-lines area-of-prolate-polar area-of-prolate-parametric area-of-oblate-polar area-of-oblate-parametric
  area-of-sphere-polar area-of-sphere-parametric area-about-another-axis area-about-another-axis-parametric
  every-bin-prolate-parametric every-bin-oblate-polar pole-on-equator statistics-of-spheres)
add_cases(fabric+contact/surface+contact/direction+contact/grain-analytic cases/contact_analytic.py LABEL case
  STYLES ${contact_measures} RANKS 1 LONG_RANKS 2 CASES
  cubic-lattice every-bin-prolate-polar opposite-bins-of-spheroids powers-add-up)
add_cases(fabric+contact/surface+contact/direction+contact/grain-analytic cases/contact_analytic.py LABEL case
  STYLES ${contact_measures} RANKS 1 LONG_RANKS 2 CASES
  every-bin-oblate-parametric opposite-bins powers-of-spheres-add-up)

# wall/gran: the motion of the host's, contacts with walls in every measure of contacts
add_cases(wall/gran-bitwise-equal cases/wall_bitwise.py LABEL case STYLES wall/gran gran/insitu RANKS 1 LONG_RANKS 2
  CASES
  walls-default)
add_cases(wall/gran-bitwise-equal cases/wall_bitwise.py LABEL case STYLES wall/gran gran/insitu RANKS 1 LONG_RANKS 2
  CASES walls-superquadric)
add_cases(wall/gran-bitwise-equal cases/wall_bitwise.py LABEL case STYLES wall/gran gran/insitu LONG_RANKS 1 2 CASES
  models-default models-superquadric)
add_cases(wall/gran-bitwise-equal cases/wall_bitwise.py LABEL case STYLES wall/gran gran/insitu surface/ellipsoid
  LONG_RANKS 1 2 CASES walls-ellipsoid)
add_cases(wall/gran-bitwise-equal cases/wall_bitwise.py LABEL case STYLES wall/gran gran/insitu surface/ellipsoid RANKS
  1 LONG_RANKS 2 CASES models-ellipsoid)
set(wall_measures wall/gran ${contact_measures} stress/contact dissipation contact/local)
add_cases(wall/gran-measures cases/wall_measures.py LABEL case STYLES ${wall_measures} RANKS 1 LONG_RANKS 2 4 CASES
  box drum)
add_cases(wall/gran-measures cases/wall_measures.py LABEL case STYLES ${wall_measures} RANKS 1 LONG_RANKS 2 4 CASES
  piston hopper box-viscous box-subgroup box-empty-group hopper-frictionless)
add_cases(wall/gran-rows cases/wall_measures.py LABEL case STYLES wall/gran contact/local RANKS 1 LONG_RANKS 2 4 CASES
  numbers-of-planes numbers-of-triangles)
add_cases(wall/gran-scene cases/wall_scenes.py LABEL case STYLES ${wall_measures} RANKS 1 LONG_RANKS 2 CASES
  column-on-a-plane column-on-a-mesh bounce-on-a-plane-e-0.1 bounce-on-a-plane-e-0.9 bounce-on-a-mesh-e-0.1
  bounce-on-a-mesh-e-0.9 booked dragged rattlers)
add_cases(wall/gran-scene cases/wall_scenes.py LABEL case STYLES wall/gran stress/contact press/strain gran/insitu
  RANKS 1 LONG_RANKS 2 4 CASES press-between-sides)
add_cases(wall/gran-scene cases/wall_scenes.py LABEL case STYLES wall/gran stress/contact press/strain gran/insitu
  RANKS 1 LONG_RANKS 2 CASES asked-before-walls change resumed-under-a-plate resumed-under-a-plate-moved-late)
add_cases(wall/gran-scene cases/wall_scenes.py LABEL case STYLES wall/gran energy/ledger RANKS 1 LONG_RANKS 2 CASES
  ledger-asked-before-walls)
add_cases(wall/gran-scene cases/wall_scenes.py LABEL case STYLES wall/gran gran/insitu RANKS 1 2 CASES unseen-walls)
add_cases(wall/gran-scene cases/wall_scenes.py LABEL case STYLES wall/gran contact/local CASES
  without-coefficients-on-a-plane without-coefficients-on-a-mesh)

# fluctuation, layering, velocity/correlation, displacement/shear, velocity/memory
set(motion_measures fluctuation layering velocity/correlation)
add_cases(fluctuation+layering+velocity/correlation-oracle cases/motion_measures.py LABEL case
  STYLES ${motion_measures} CASES
  spheres-at-rest spheres-polydisperse spheroid-0.33 spheroid-0.67 spheroid-1 spheroid-3 triaxial tilted-backward
  under-pressure-control sheared-in-xz sheared-in-yz group-of-one)
add_cases(fluctuation+layering+velocity/correlation-oracle cases/motion_measures.py LABEL case
  STYLES ${motion_measures} RANKS 1 2 CASES spheroid-1.5)
add_cases(fluctuation+layering+velocity/correlation-oracle cases/motion_measures.py LABEL case
  STYLES ${motion_measures} RANKS 1 LONG_RANKS 2 CASES spheres spheres-through-a-flip subgroup)
set(motions fluctuation layering displacement/shear velocity/memory grain/record)
add_cases(fluctuation+layering+displacement/shear+velocity/memory-analytic cases/motion_analytic.py LABEL case
  STYLES ${motions} CASES
  rarely-asked affine-backward affine-without-stretch drifting-backward drifting-in-xz drifting-in-yz rigid lever
  starts-late)
add_cases(fluctuation+layering+displacement/shear+velocity/memory-analytic cases/motion_analytic.py LABEL case
  STYLES ${motions} RANKS 1 LONG_RANKS 2 CASES replaced-grains affine planes-of-grains remembers)
add_cases(fluctuation+layering+displacement/shear+velocity/memory-analytic cases/motion_analytic.py LABEL case
  STYLES ${motions} RANKS 1 LONG_RANKS 2 CASES
  rarely-asked-backward drifting drifting-under-press-strain energies random-walk later-grains remembers-later-grains)
add_cases(fluctuation-range cases/ranges.py LABEL case STYLES fluctuation RANKS 1 LONG_RANKS 2 CASES profile)
set(series displacement/shear velocity/memory grain/record)
add_cases(displacement/shear+velocity/memory-oracle cases/series_measures.py LABEL case STYLES ${series} CASES
  spheroids backward backward-under-pressure-control)
add_cases(displacement/shear+velocity/memory-oracle cases/series_measures.py LABEL case STYLES ${series} RANKS 1
  LONG_RANKS 2 CASES
  under-pressure-control)
add_cases(displacement/shear+velocity/memory-oracle cases/series_measures.py LABEL case STYLES ${series}
  RANKS 1 LONG_RANKS 2 CASES spheres sheared-in-yz subgroup)
add_cases(velocity/correlation-oracle cases/correlation_measures.py LABEL case STYLES velocity/correlation LONG_RANKS 1
  CASES spheres-at-rest polydisperse spheroid-0.33 tilted-backward sheared-in-yz)
add_cases(velocity/correlation-oracle cases/correlation_measures.py LABEL case STYLES velocity/correlation CASES
  sheared-in-xz group-of-one not-periodic decays)
add_cases(velocity/correlation-oracle cases/correlation_measures.py LABEL case STYLES velocity/correlation
  LONG_RANKS 1 CASES spheroid-3)
add_cases(velocity/correlation-oracle cases/correlation_measures.py LABEL case STYLES velocity/correlation RANKS 1
  LONG_RANKS 2 CASES through-a-flip plane-wave-on-a-mesh asked-beside)
add_cases(velocity/correlation-oracle cases/correlation_measures.py LABEL case STYLES velocity/correlation LONG_RANKS 1
  2 CASES one-search)
add_cases(velocity/correlation-oracle cases/correlation_measures.py LABEL case STYLES velocity/correlation
  RANKS 1 LONG_RANKS 2 CASES spheres under-pressure-control subgroup running plane-wave)

# press/strain
add_cases(press/strain-faces-that-close cases/faces_that_close.py LABEL case STYLES press/strain gran/insitu
  RANKS 1 LONG_RANKS 2 4 CASES pressed pressed-and-sheared deformed)
add_cases(press/strain-control cases/press_strain.py LABEL case STYLES press/strain CASES
  shears-backward-as-fix-deform shears-in-xz shears-in-yz recursion-clipped recursion-clipped-by-rate
  recursion-every-time recursion-negative-rate inputs-every-strain inputs-every-time inputs-every-step
  holds-the-target target-zero-expands target-follows-a-variable without-shear momentum-kept)
add_cases(press/strain-control cases/press_strain.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2 CASES
  shears-as-fix-deform restart-continues)
add_cases(press/strain-control cases/press_strain.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2 CASES
  recursion-every-strain automatic-gain at-the-target-nothing-moves momentum-removed kinetic-part-counts)
add_cases(press/strain-control cases/press_strain.py LABEL case STYLES press/strain RANKS 2 LONG_RANKS 4 CASES
  same-on-ranks restart-on-other-ranks)
add_cases(press/strain-analytic cases/press_analytic.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2 CASES
  automatic-gain-compresses automatic-gain-expands automatic-gain-of-hooke)
add_cases(press/strain-analytic cases/press_analytic.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2
  CASES given-gain)
add_cases(press/strain-path-by-hand cases/stress_path_analytic.py LABEL case STYLES press/strain CASES
  two-edges an-edge-by-the-old-form-and-one-driven mean-with-ratios-beside-a-rate shear-stress
  sheared-in-two-planes-under-pressure)
add_cases(press/strain-path-by-hand cases/stress_path_analytic.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2
  CASES three-edges mean shear-stress-and-pressure)
add_cases(press/strain-path cases/stress_paths.py LABEL case STYLES press/strain CASES oedometer-frictionless
  oedometer-with-springs lattice-under-a-mean volume-stays targets-follow-variables in-two-dimensions
  part-of-the-grains)
add_cases(press/strain-path cases/stress_paths.py LABEL case STYLES press/strain LONG_RANKS 1 CASES sheared-in-xy-and-xz
  sheared-in-xy-and-yz)
add_cases(press/strain-path cases/stress_paths.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2 4 CASES
  lattice-under-three-targets holds-a-shear-stress next-stage between-runs between-walls)
add_cases(press/strain-path cases/stress_paths.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2 4 CASES
  sheared-in-three-planes-and-stretched whatever-lists-are-built whatever-lists-are-built-on-every-edge
  restart-continues restart-continues-with-a-mean-and-a-shear-stress)
add_cases(press/strain-path cases/stress_paths.py LABEL case STYLES press/strain RANKS 2 LONG_RANKS 4 CASES
  same-on-ranks-with-a-mean-and-a-shear-stress)
add_cases(press/strain-path cases/stress_paths.py LABEL case STYLES press/strain LONG_RANKS 2 4 CASES same-on-ranks)
add_cases(press/strain-path cases/stress_paths.py LABEL long STYLES press/strain CASES flows-at-a-shear-stress)
add_cases(press/strain-range cases/ranges.py LABEL case STYLES press/strain RANKS 1 LONG_RANKS 2 CASES clipping)
add_cases(press/strain-runs cases/stress_path_runs.py LABEL case STYLES press/strain stress/contact
  RANKS 1 LONG_RANKS 2 CASES isotropic-spheres)
add_cases(press/strain-runs cases/stress_path_runs.py LABEL case
  STYLES press/strain stress/contact surface/ellipsoid nve/spheroid RANKS 1 LONG_RANKS 2 CASES isotropic-spheroids)
add_cases(press/strain-runs cases/stress_path_runs.py LABEL case STYLES press/strain energy/ledger stress/contact
  RANKS 1 LONG_RANKS 2 CASES
  ledger-triaxial ledger-isotropic ledger-mean ledger-constant-volume ledger-two-planes ledger-two-planes-one-held
  ledger-triaxial-spheres)
add_cases(press/strain-runs cases/stress_path_runs.py LABEL case STYLES press/strain packing stress/contact
  LONG_RANKS 1 CASES critical-dense-and-loose critical-pressure-and-volume)

# Fixes that wait for a step whose number is changed
add_cases(stress/contact+field/write-renumbered cases/renumbered.py LABEL case STYLES stress/contact field/write RANKS 1
  LONG_RANKS 2 CASES begun-again not-set-up higher)

# press/wall
add_cases(press/wall-analytic cases/press_wall_analytic.py LABEL case STYLES press/wall RANKS 1 LONG_RANKS 2 CASES
  automatic-gain-gives-way automatic-gain-of-hooke from-below-along-x along-y clipped clipped-by-maxrate starts-softly
  two-dimensions in-cgs follows-behind follows-with-a-base-of-hooke base-with-a-given-gain base-at-rest)
add_cases(press/wall-analytic cases/press_wall_analytic.py LABEL case STYLES press/wall RANKS 1 LONG_RANKS 2 CASES
  automatic-gain-presses given-gain follows-with-a-base)
add_cases(press/wall-bed cases/press_wall.py LABEL case STYLES press/wall RANKS 1 LONG_RANKS 2 4 CASES
  holds-spheres restarted restarted-neutral)
add_cases(press/wall-bed cases/press_wall.py LABEL case STYLES press/wall RANKS 1 LONG_RANKS 2 CASES holds-spheroids
  holds-hooke stable-every-step stable-bouncing stable-damped target-follows-a-variable counts-time group sinking)
add_cases(press/wall-bed cases/press_wall.py LABEL case STYLES press/wall LONG_RANKS 1 2 CASES stable-rarely
  smaller-plates)
add_cases(press/wall-bed cases/press_wall.py LABEL case STYLES press/wall RANKS 2 LONG_RANKS 4 CASES same-on-ranks)
add_cases(press/wall-bed cases/press_wall.py LABEL case STYLES press/wall energy/ledger RANKS 1 LONG_RANKS 2 CASES
  energy)

# nve/spheroid
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid LONG_RANKS 1 CASES
  flows-as-host-0.5)
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid CASES boxy-grains)
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid LONG_RANKS 1 CASES
  flows-as-host-1.5)
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid RANKS 1 LONG_RANKS 2 CASES
  energy-kept some-grains first-group collision-of-prolate-grains collision-of-oblate-grains inserted-grains)
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid RANKS 1 LONG_RANKS 2
  CASES restart-continues)
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid RANKS 1 LONG_RANKS 2 4 CASES
  shears-as-host-1.5)
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid RANKS 1 LONG_RANKS 2 4 CASES
  free-flight free-flight-in-large-turns)
add_cases(nve/spheroid-motion cases/spheroid_motion.py LABEL case STYLES nve/spheroid LONG_RANKS 1 2 4 CASES
  shears-as-host-0.5)

# surface ellipsoid, contact/solver
add_cases(surface/ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case STYLES surface/ellipsoid LONG_RANKS 1
  CASES spheroid-0.33 spheroid-3)
add_cases(surface/ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case STYLES surface/ellipsoid CASES spheres
  polydisperse frozen-grains narrow-contact-distance gaussian-curvature mean-curvature mean-curvature-of-mixed-shapes
  curvature-keywords-without-limit tangential-off tangential-no-history hooke rolling-cdt rolling-epsd2
  limit-force-undamped moved-by-nve-spheroid mixed-shapes-and-types cohesion spheres-of-five-sizes frozen-spheres
  softened-spheres rods-squeezed-by-the-box tumbling-rods-with-jumps tumbling-rods-shrink-wrapped pushed-rods
  shapes-set-between-runs)
add_cases(surface/ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case STYLES surface/ellipsoid RANKS 1
  LONG_RANKS 2 CASES
  spheroid-1.5 tumbling-rods-in-a-deforming-box)
add_cases(surface/ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case STYLES surface/ellipsoid CASES
  observed-spheres observed-tangential-off observed-tangential-no-history observed-undamped observed-limit-force
  observed-hooke observed-hooke-two-sevenths observed-gaussian-curvature observed-rolling observed-with-ledger
  observed-stiffness)
add_cases(surface/ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case STYLES surface/ellipsoid
  RANKS 1 LONG_RANKS 2 4 CASES
  observed-spheroids observed-mixed-shapes-and-types observed-spheres-and-spheroids observed-frozen)
add_cases(surface/ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case STYLES surface/ellipsoid
  RANKS 1 LONG_RANKS 2 CASES spheres-here-spheroids-there tumbling-rods tumbling-rods-between-walls between-runs)
add_cases(surface/ellipsoid-host cases/pair_host.py LABEL case STYLES surface/ellipsoid gran/insitu
  RANKS 1 LONG_RANKS 2 CASES
  virial-of-ellipsoids restart-of-ellipsoids-continues pair-local-output-does-not-disturb-ellipsoids)
add_cases(surface/ellipsoid-forces cases/ellipsoid_forces.py LABEL case STYLES surface/ellipsoid contacthistory
  LONG_RANKS 1 CASES spheroid-0.33 spheroid-3 polydisperse)
add_cases(surface/ellipsoid-forces cases/ellipsoid_forces.py LABEL case STYLES surface/ellipsoid contacthistory CASES
  spheroid-0.5 spheres gaussian-curvature mean-curvature limit-without-curvature-keywords flows-on-from-the-other
  restart-of-prolate-grains restart-of-oblate-grains)
add_cases(surface/ellipsoid-forces cases/ellipsoid_forces.py LABEL case STYLES surface/ellipsoid
  RANKS 1 LONG_RANKS 2 CASES spheroid-1.5 restart-before-a-flip)
add_cases(surface/ellipsoid-forces cases/ellipsoid_forces.py LABEL case STYLES surface/ellipsoid LONG_RANKS 2 CASES
  start-survives-a-swap)
add_cases(surface/ellipsoid-wall cases/ellipsoid_walls.py LABEL case STYLES surface/ellipsoid CASES
  prolate-on-a-plane prolate-on-a-cylinder prolate-on-a-mesh oblate-on-a-plane oblate-on-a-cylinder oblate-on-a-mesh
  triaxial-on-a-plane triaxial-on-a-cylinder triaxial-on-a-mesh sphere-on-a-plane gaussian-curvature-on-a-plane
  gaussian-curvature-on-a-mesh mean-curvature-on-a-plane mean-curvature-on-a-mesh limit-alone-on-a-plane
  limit-alone-on-a-mesh)
add_cases(surface/ellipsoid-wall cases/ellipsoid_walls.py LABEL case STYLES surface/ellipsoid RANKS 1 LONG_RANKS 2 CASES
  pile)
add_cases(wall/gran-mended cases/walls_mended.py LABEL case STYLES wall/gran RANKS 1 CASES
  cylinder-turns-x-inside cylinder-turns-x-inside-narrow cylinder-turns-x-outside
  cylinder-turns-y-inside cylinder-turns-y-inside-narrow cylinder-turns-y-outside
  cylinder-turns-z-inside cylinder-turns-z-inside-narrow cylinder-turns-z-outside
  floor-diagonal-superquadric floor-beside-the-diagonal-superquadric floor-far-superquadric floor-diagonal-ellipsoid
  floor-beside-the-diagonal-ellipsoid floor-far-ellipsoid edge-superquadric edge-ellipsoid)
add_cases(wall/gran-mended cases/walls_mended.py LABEL case STYLES wall/gran RANKS 1 LONG_RANKS 2 CASES
  torque-large torque-small torque-ellipsoid second-run)
add_cases(surface/ellipsoid-contact cases/ellipsoid_contacts.py LABEL case STYLES surface/ellipsoid CASES
  poles-meet poles-meet-gaussian poles-meet-mean equators-meet-gaussian equators-meet-mean flat-faces-meet-gaussian
  flat-faces-meet-mean unlike-grains-meet unlike-grains-meet-gaussian unlike-grains-meet-mean sphere-meets-pole-mean
  triaxial-meets-sphere-gaussian triaxial-meets-sphere-mean spheres-meet spheres-meet-mean limit-caps-the-radius
  limit-below-one-caps-spheres spheres-collide spheres-collide-head-on spheres-collide-hooke-no-history
  spheres-collide-rolling spheres-part-at-e concentric-spheres concentric-spheroids concentric-triaxial
  no-stale-springs no-stale-springs-of-poles host-keeps-springs host-keeps-springs-of-poles)
add_cases(surface/ellipsoid-contact cases/ellipsoid_contacts.py LABEL case STYLES surface/ellipsoid LONG_RANKS 2 CASES
  concentric-between-ranks)
add_cases(contact/solver-counts cases/contact_solver.py LABEL case STYLES contact/solver surface/ellipsoid
  RANKS 1 LONG_RANKS 2 4 CASES lists-and-contacts)
add_cases(contact/solver-counts cases/contact_solver.py LABEL case STYLES contact/solver surface/ellipsoid
  RANKS 1 LONG_RANKS 2 CASES add-up begins-with-the-pair-style does-not-disturb)
add_cases(contact/solver-counts cases/contact_solver.py LABEL case STYLES contact/solver surface/ellipsoid
  RANKS 2 LONG_RANKS 4 CASES same-on-ranks)

# energy/ledger
set(ledger energy/ledger ledger/record dissipation)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} LONG_RANKS 1 CASES
  sheared-frictionless polydisperse drift-kept synchronized-no-history synchronized-open-and-close)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} CASES no-history synchronized-damped
  synchronized-under-pressure-control)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} LONG_RANKS 1 CASES sheared-slippery)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} RANKS 1 LONG_RANKS 2 CASES sheared)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} LONG_RANKS 1 2 CASES synchronized)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} LONG_RANKS 1 2 4 CASES three-rates)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} LONG_RANKS 1 2 CASES
  sheared-with-tangential-damping through-a-flip)
add_cases(energy/ledger-oracle cases/ledger_oracle.py LABEL case STYLES ${ledger} RANKS 1 LONG_RANKS 2 CASES
  contacts-open-and-close under-pressure-control three-rates-and-shear)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} LONG_RANKS 1 CASES two-spheres two-flat
  two-long-3 two-triaxial two-spheres-default two-long-1.5-superquadric)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} CASES order-spheres order-flat order-long-1.5
  order-long-3 known-collision hooke no-history tangential-damping tangential-off limit-force curvature rolling-cdt
  rolling-epsd rolling-epsd2 rolling-superquadric sheared-0.33-mu-0 sheared-0.33-mu-0.4 sheared-0.33-mu-10
  sheared-1.5-mu-0 sheared-1.5-mu-0.4 sheared-1.5-mu-10 sheared-3-mu-0 sheared-3-mu-0.4 sheared-3-mu-10 pressed-0.33
  pressed-1 pressed-3 pressed-spheres pressed-dilute pressed-along-the-flow sheared-1-mu-0 sheared-1-mu-0.4
  sheared-1-mu-10 pressed-1.5-mu-0 pressed-1.5-mu-10 energy-of-hertz energy-of-hooke energy-with-curvature
  restart-before-the-first-step asked-within-a-step overlap-of-nothing lists reopening-spheres reopening-stale-springs
  reopening-spheroids step-mode-is-the-trapezium superquadric)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} gran/insitu CASES
  two-spheres-default-synchronized two-superquadric-synchronized two-flat-synchronized hooke-synchronized
  no-history-synchronized damped-synchronized superquadric-synchronized lanes-synchronized-spheres
  lanes-synchronized-round lanes-synchronized-spheroids undisturbed-synchronized-spheres
  restart-synchronized-superquadrics)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} gran/insitu LONG_RANKS 1 CASES
  two-spheres-synchronized two-long-1.5-synchronized undisturbed-synchronized-superquadrics)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} gran/insitu RANKS 1 LONG_RANKS 2 4 CASES
  sheared-synchronized pressed-spheres-synchronized types-synchronized mixture-synchronized
  undisturbed-synchronized-spheroids restart-synchronized-spheres)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} gran/insitu RANKS 2 LONG_RANKS 4 CASES
  same-synchronized-spheres)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} gran/insitu LONG_RANKS 2 4 CASES
  same-synchronized-spheroids)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} gran/insitu setup/memory CASES
  restart-synchronized-spheroids)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} RANKS 1 LONG_RANKS 2
  CASES flip restart-continues)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} RANKS 1 LONG_RANKS 2 4 CASES
  restart-in-a-box-of-three-rates)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} RANKS 1 LONG_RANKS 2 CASES
  two-long-1.5 polydisperse-two-types wraps runs groups falling undisturbed rates-add-up)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} RANKS 1 LONG_RANKS 2 4 CASES pressed-1.5)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} RANKS 2 LONG_RANKS 4 CASES same-spheroids)
add_cases(energy/ledger-closes cases/ledger.py LABEL case STYLES ${ledger} LONG_RANKS 2 4 CASES same-spheres)
add_cases(energy/ledger-walls cases/ledger_walls.py LABEL case STYLES ${ledger} wall/gran LONG_RANKS 1 CASES
  bounce-plane bounce-plane-spheres bounce-no-history restarted-neutral bounce-synchronized-long
  bounce-synchronized-no-history)
add_cases(energy/ledger-walls cases/ledger_walls.py LABEL case STYLES ${ledger} wall/gran CASES bounce-long bounce-hooke
  bounce-damped bounce-rolling shear moving pulls frozen bounce-synchronized-spheres bounce-synchronized-superquadric
  plate-synchronized restarted-synchronized-neutral)
add_cases(energy/ledger-walls cases/ledger_walls.py LABEL case STYLES ${ledger} wall/gran RANKS 1 LONG_RANKS 2 4 CASES
  seen-from-outside bounce-mesh plate conveyor drum hopper-spheres drops-out between-runs in-a-box-that-shears
  other-laws drained drum-synchronized drum-synchronized-walls drum-synchronized-grains hopper-synchronized)
add_cases(energy/ledger-walls cases/ledger_walls.py LABEL case STYLES ${ledger} wall/gran RANKS 1 LONG_RANKS 2 4 CASES
  hopper-spheroids torn-apart rained restarted in-a-box-that-stretches)
add_cases(energy/ledger-walls cases/ledger_walls.py LABEL case STYLES ${ledger} wall/gran LONG_RANKS 1 2 4 CASES
  restarted-synchronized)
set(ledger_flows ${ledger} wall/gran wall/contact)
add_cases(energy/ledger-flows cases/ledger_flows.py LABEL case STYLES ${ledger_flows} RANKS 1 LONG_RANKS 2 4 CASES
  small-silo small-drum)
add_cases(energy/ledger-flows cases/ledger_flows.py LABEL long STYLES ${ledger_flows} CASES silo drum)

# read_restart, setup neutral, run/guard: runs that are split, killed, stopped, damaged
add_cases(setup/memory-split cases/restarts.py LABEL case STYLES setup/memory gran/insitu RANKS 1 LONG_RANKS 2 CASES
  split-spheroids)
add_cases(setup/memory-split cases/restarts.py LABEL case STYLES setup/memory gran/insitu RANKS 1 LONG_RANKS 2 CASES
  split-through-a-flip measures-go-on)
add_cases(setup/memory-split cases/restarts.py LABEL case STYLES setup/memory gran/insitu CASES split-spheres
  split-of-spheres-through-a-flip split-with-rolling split-without-history split-with-gravity split-by-the-host
  noticed-freezing noticed-velocities noticed-spins noticed-places noticed-box noticed-deletion noticed-time-step)
add_cases(setup/memory-split cases/restarts.py LABEL case STYLES setup/memory gran/insitu LONG_RANKS 1 CASES
  split-superquadrics split-after-no-step)
set(resumed read_restart run/guard setup/memory)
add_cases(read_restart-goes-on cases/restarts.py LABEL case STYLES ${resumed} RANKS 1 LONG_RANKS 2
  CASES exact-spheroids)
add_cases(read_restart-goes-on cases/restarts.py LABEL case STYLES ${resumed} LONG_RANKS 4 CASES exact-spheroids)
add_cases(read_restart-goes-on cases/restarts.py LABEL case STYLES ${resumed} RANKS 1 LONG_RANKS 2 CASES exact-spheres)
add_cases(read_restart-goes-on cases/restarts.py LABEL case STYLES ${resumed} LONG_RANKS 1 2 CASES killed-a-few-times)
add_cases(read_restart-goes-on cases/restarts.py LABEL case STYLES ${resumed} CASES killed-twice)
add_cases(read_restart-goes-on cases/restarts.py LABEL case STYLES ${resumed} CASES
  exact-superquadrics exact-by-the-host)
add_cases(read_restart-goes-on cases/restarts.py LABEL long STYLES ${resumed} RANKS 1 2 CASES
  killed-spheres killed-spheroids)
add_cases(read_restart-recipe cases/recipes.py LABEL case STYLES ${resumed} LONG_RANKS 1 CASES page-on-running
  example-with-mpirun written-out prolonged-as-shown)
add_cases(read_restart-recipe cases/recipes.py LABEL case STYLES ${resumed} CASES example stopped-in-order first-rows
  complete-wherever-shown)
add_cases(read_restart+energy/ledger-recipe cases/recipes.py LABEL case STYLES ${resumed} energy/ledger
  CASES with-ledger)
add_cases(build-job-scripts cases/recipes.py LABEL case STYLES build CASES job-scripts-are-named)
add_cases(read_restart-damage cases/damage.py LABEL case STYLES read_restart LONG_RANKS 1 2 CASES restart-cut)
add_cases(read_restart-damage cases/damage.py LABEL case STYLES read_restart RANKS 1 LONG_RANKS 2 CASES restart-flipped
  other-settings)
add_cases(read_restart-damage cases/damage.py LABEL case STYLES read_restart RANKS 1 LONG_RANKS 2
  CASES newest-whole-one)
add_cases(read_restart-damage cases/damage.py LABEL case STYLES read_restart LONG_RANKS 1 CASES plain-gran-and-back)
add_cases(read_restart-damage cases/damage.py LABEL long STYLES read_restart CASES
  restart-cut-often restart-flipped-often)
add_cases(run/guard-stopped cases/restarts.py LABEL case STYLES run/guard RANKS 1 LONG_RANKS 2 4 CASES sigterm)
add_cases(run/guard-stopped cases/restarts.py LABEL case STYLES run/guard RANKS 1 LONG_RANKS 2 CASES
  sigterm-between-short-runs)
add_cases(run/guard-stopped cases/restarts.py LABEL case STYLES run/guard RANKS 2 LONG_RANKS 4 CASES
  sigterm-to-one-rank)
add_cases(run/guard-stopped cases/restarts.py LABEL case STYLES run/guard LONG_RANKS 2 CASES sigint)
add_cases(run/guard-damage cases/damage.py LABEL case STYLES run/guard RANKS 1 LONG_RANKS 2 CASES
  velocity-nan lost-from-a-periodic-box)
add_cases(run/guard-damage cases/damage.py LABEL case STYLES run/guard RANKS 1 LONG_RANKS 2 CASES
  force-inf too-long-a-step)
add_cases(run/guard-damage cases/damage.py LABEL case STYLES run/guard CASES may-leave-an-open-box
  lost-beside-an-open-face disk-full-snapshots disk-full-dump disk-full-table disk-full-restart)
add_cases(run/guard-damage cases/damage.py LABEL case STYLES run/guard LONG_RANKS 1 CASES disk-full-log)

# All styles at once: ranks, ways to ask, changes between runs, decompositions, orders of grains, builds, lifetimes
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL RANKS 2 LONG_RANKS 4 CASES
  spheroids ellipsoids)
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL LONG_RANKS 2 4 CASES spheres)
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL RANKS 4 CASES empty-ranks empty-group)
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL LONG_RANKS 4 CASES
  oblate-grains subgroup restart-on-other-ranks)
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL CASES empty-group-of-spheres)
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL RANKS 1 2 CASES restart-continues)
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL LONG_RANKS 1 2 CASES does-not-disturb-spheres)
add_cases(every-style-same cases/same_everywhere.py LABEL case STYLES ALL RANKS 1 LONG_RANKS 2 CASES
  does-not-disturb-spheroids restart-refused restart-of-spheres-continues)
add_cases(every-style-asked cases/asking.py LABEL case STYLES ALL CASES
  as-pair-gran-local-spheres as-pair-gran-local-spheroids as-pair-gran-local-oblate dumped means variables
  orthogonal-box as-pair-gran-local-ellipsoids as-pair-gran-local-oblate-ellipsoids)
add_cases(every-style-asked cases/asking.py LABEL case STYLES ALL RANKS 1 LONG_RANKS 2 CASES
  scalars vectors come-and-go)
add_cases(every-style-changes cases/changes.py LABEL case STYLES ALL CASES
  box-turned-triclinic grains-deleted-and-renumbered pair-style-twice-at-first compute-before-pair-style
  time-step-changed-between-runs time-step-changed-every-ten-steps loss-while-the-time-step-changes)
add_cases(every-style-changes cases/changes.py LABEL case STYLES ALL RANKS 1 2 CASES grains-lost)
add_cases(every-style-changes cases/changes.py LABEL case STYLES ALL RANKS 1 LONG_RANKS 2 CASES
  box-turned-orthogonal grains-deleted clear-starts-afresh-with-ellipsoids pair-style-twice
  time-step-changed-in-mid-run box-scaled groups-changed-without-set-up)
add_cases(every-style-changes cases/changes.py LABEL case STYLES ALL RANKS 1 LONG_RANKS 2 4 CASES grains-inserted
  steps-renumbered)
add_cases(every-style-changes cases/changes.py LABEL case STYLES ALL LONG_RANKS 1 2 4 CASES clear-starts-afresh)
add_cases(every-style-rank-sweep cases/rank_sweep.py LABEL case STYLES ALL RANKS 8 CASES spheroids-through-a-flip)
add_cases(every-style-rank-sweep cases/rank_sweep.py LABEL case STYLES ALL LONG_RANKS 8 CASES
  spheres superquadrics-through-a-flip)
add_cases(every-style-rank-sweep cases/rank_sweep.py LABEL long STYLES ALL RANKS 8 CASES every-decomposition)
add_cases(every-style-decomposition cases/decomposition.py LABEL case STYLES ALL LONG_RANKS 2 CASES
  on-corners-of-a-tilted-box)
add_cases(every-style-decomposition cases/decomposition.py LABEL case STYLES ALL RANKS 4 CASES
  just-below-the-least-height)
add_cases(every-style-decomposition cases/decomposition.py LABEL case STYLES ALL LONG_RANKS 4 CASES empty-ranks)
add_cases(every-style-decomposition cases/decomposition.py LABEL case STYLES ALL LONG_RANKS 3 CASES
  just-above-the-least-height just-above-the-least-height-of-ellipsoids)
add_cases(every-style-decomposition cases/decomposition.py LABEL case STYLES ALL RANKS 1 LONG_RANKS 3 CASES
  arrive-on-the-upper-face shrinks-by-press-strain shrinks-by-fix-deform shrinks-by-change-box sheared-too-narrow
  restart-of-grains-beyond-the-box)
add_cases(every-style-decomposition cases/decomposition.py LABEL case STYLES ALL CASES host-cannot-balance)
add_cases(every-style-decomposition cases/decomposition.py LABEL long STYLES ALL RANKS 2 3 4 8 CASES
  on-corners spheres-on-corners-of-a-tilted-box)
add_cases(every-style-decomposition cases/decomposition.py LABEL long STYLES ALL RANKS 3 4 8 CASES
  on-corners-of-a-tilted-box)
add_cases(every-style-decomposition cases/decomposition.py LABEL long STYLES ALL RANKS 2 3 8 CASES
  just-below-the-least-height)
add_cases(every-style-decomposition cases/decomposition.py LABEL long STYLES ALL RANKS 2 4 8 CASES
  just-above-the-least-height just-above-the-least-height-of-ellipsoids)
add_cases(every-style-decomposition cases/decomposition.py LABEL long STYLES ALL RANKS 3 CASES migrants)
add_cases(every-style-decomposition cases/decomposition.py LABEL long STYLES ALL RANKS 8 CASES
  migrants empty-ranks arrive-on-the-upper-face shrinks-by-press-strain shrinks-by-fix-deform shrinks-by-change-box
  sheared-too-narrow restart-of-grains-beyond-the-box)
add_cases(every-style-rank-statistics cases/rank_statistics.py LABEL long STYLES ALL RANKS 4 CASES prolate-flow)
add_cases(every-style-shuffle cases/shuffle.py LABEL case STYLES ALL RANKS 1 CASES ellipsoids)
add_cases(every-style-shuffle cases/shuffle.py LABEL case STYLES ALL LONG_RANKS 3 CASES spheres)
add_cases(every-style-shuffle cases/shuffle.py LABEL long STYLES ALL RANKS 1 CASES spheres superquadrics)
add_cases(every-style-shuffle cases/shuffle.py LABEL long STYLES ALL RANKS 4 8 CASES ellipsoids superquadrics)
add_cases(every-style-builds numerics/builds.py LABEL long STYLES ALL RANKS 1 2 CASES spheres spheroids superquadrics)
add_cases(every-style-lifetimes cases/lifetimes.py LABEL case STYLES ALL CASES every-style-is-here)
add_cases(every-style-lifetimes cases/lifetimes.py LABEL case STYLES ALL LONG_RANKS 1 CASES
  computes-1000-times fixes-1000-times pair-styles-1000-times pair-styles-not-compiled-1000-times
  computes-asked-100-times fixes-run-100-times pair-styles-run-200-times plates-1000-times plates-run-100-times)
add_cases(every-style-lifetimes cases/lifetimes.py LABEL long STYLES ALL RANKS 2 CASES
  computes-asked-100-times fixes-run-100-times)
add_cases(every-style-soak cases/soak.py LABEL case STYLES ALL LONG_RANKS 1 2 CASES spheroids-over-1e4-steps)
add_cases(every-style-soak cases/soak.py LABEL long STYLES ALL RANKS 1 2 CASES spheroids-over-1e5-steps)
add_cases(every-style-soak cases/soak.py LABEL long STYLES ALL CASES spheroids-over-1e6-steps spheres-over-1e6-steps)

# The study
add_cases(study-config cases/study_config.py LABEL case STYLES study CASES
  runs-of-lists exceptions numbers-that-yaml-takes-for-words example-is-valid howto-has-the-grid-of-the-paper
  every-figure-is-asked-for steps-of-deck unknown-word empty-list no-list word-for-number yes-for-number
  negative-friction half-a-grain not-finite twice steady-beyond-strain exception-steady measure exception-shape
  exceptions-no-list exception-where exception-use exception-value output ranks
  groups paper-size groups-no-list group-words group-no-points group-keyword group-value group-twice)
add_cases(study-fits cases/study_fits.py LABEL case STYLES study CASES friction-law fraction-law power-law
  without-errors decay refused crossing level-set laws-of-grid laws-of-shape seeds-and-sizes agreement
  published-of-grid)
add_cases(study-fits cases/study_fits.py LABEL case STYLES study LONG_RANKS 1 CASES curves-that-do-not-bend)
add_cases(study-runs cases/study_runs.py LABEL case STYLES study RANKS 1 LONG_RANKS 2 CASES
  killed-run-continues longer-strain-continues)
add_cases(study-runs cases/study_runs.py LABEL case STYLES study LONG_RANKS 1 CASES one-at-a-time
  stopped-run-has-not-ended out-of-time hours-refused first-restart-cut no-restart-whole part-must-be-named)
add_cases(study-runs cases/study_runs.py LABEL case STYLES study CASES other-variables-refused reason-is-given
  means-of-files table-holds-everything)
add_cases(study-slices cases/study_slices.py LABEL case STYLES study CASES parts-within-time first-that-fits
  stopped-slice-goes-on one-slice-at-a-time nothing-fits failures-are-told options-refused)
add_cases(study-slices cases/study_slices.py LABEL case STYLES study LONG_RANKS 1 CASES killed-slice-goes-on
  killed-slice-leaves-none)
add_cases(study-partial cases/study_partial.py LABEL case STYLES study CASES status-of-known-files status-of-nothing
  partial-is-marked table-refusals data-set-refused metadata earlier-runs earlier-refused every-column-has-a-source)
add_cases(study-partial cases/study_partial.py LABEL case STYLES study LONG_RANKS 1 CASES data-set)
add_cases(study-workflow cases/study_workflow.py LABEL case STYLES study CASES basic-measures)
add_cases(study-workflow cases/study_workflow.py LABEL case STYLES study LONG_RANKS 1 CASES bad-configuration)
add_cases(study-workflow cases/study_workflow.py LABEL case STYLES study LONG_RANKS 1 CASES
  failing-runs-do-not-stop-others study-goes-on)
add_cases(tools cases/tools_command.py LABEL case STYLES tools CASES help-of-all unknown-refused missing-input-refused
  runs-refused python-without-numpy missing-packages-named packages-are-installed-by-scripts syntax-of-python-3-9
  progress-is-said run-is-followed)
add_cases(tools cases/tools_command.py LABEL case STYLES tools LONG_RANKS 1 CASES examples-of-page)
add_cases(tools-plot cases/tools_plot.py LABEL case STYLES tools CASES
  known-error constants steady-parts files-of-the-program picture not-finite command-line)
add_cases(tools-rows cases/tools_rows.py LABEL case STYLES tools CASES
  tables files-of-the-program incomplete command-line)
add_cases(tools-fields cases/field_pictures.py LABEL case STYLES tools CASES cells-in-order profiles empty-cells
  error-bands several-files maps tilted-maps slices arrows rings groups-and-columns not-finite bad-files command-line)
add_cases(tools-fields cases/field_pictures.py LABEL case STYLES tools LONG_RANKS 1 CASES animation)
add_cases(study-slurm cases/study_slurm.py LABEL long STYLES study CASES slurm-grid)

# What ends between runs: the last step of a run is known after it
add_cases(stress/contact-last-step cases/last_step.py LABEL case
  STYLES stress/contact fabric dissipation contact/surface contact/direction RANKS 1 LONG_RANKS 2 CASES
  after-a-run by-update-on-run-end)
add_cases(stress/contact-last-step cases/last_step.py LABEL case
  STYLES stress/contact fabric dissipation contact/surface contact/direction CASES
  grains-move-as-without in-formulas loops thermo-changed stays-until-the-next-run)
add_cases(contact/grain-last-step cases/last_step.py LABEL case STYLES contact/grain RANKS 1 LONG_RANKS 2 CASES
  grains-change-between-runs)
add_cases(contact/local-last-step cases/last_step.py LABEL case STYLES contact/local CASES rows-after-a-run)
add_cases(energy/ledger-last-step cases/last_step.py LABEL case
  STYLES energy/ledger displacement/shear velocity/memory dissipation CASES sums-are-not-asked-twice)

# The first evaluation of a run, the friction limit, cohesion
add_cases(gran/insitu-first-evaluation cases/first_evaluation.py LABEL case
  STYLES gran/insitu run/guard contact/local contact/grain dissipation stress/contact CASES
  neutral repeated-row after-a-change below-the-limit spin-on-a-frictionless-plane spin-on-a-frictionless-mesh
  friction-of-a-plane friction-of-a-mesh)
add_cases(gran/insitu-first-evaluation cases/first_evaluation.py LABEL case
  STYLES gran/insitu run/guard contact/local contact/grain dissipation stress/contact RANKS 1 LONG_RANKS 2 CASES
  as-the-host packings beside-a-mesh-moved-before beside-a-mesh-moved-after when-a-motion-ends)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation gran/insitu
  LONG_RANKS 1 CASES sjkr sjkr2 sjkr-no-history sjkr-limit-force neutral-slippery neutral-two-types)
add_cases(contact/local+dissipation-law cases/sphere_law.py LABEL case STYLES contact/local dissipation gran/insitu
  CASES sjkr-reduces-friction neutral)
add_cases(contact/local+contact/grain+contact/surface-friction-limit cases/friction_limit.py LABEL case
  STYLES contact/local contact/grain contact/surface dissipation CASES
  spheroids-cohesion-reduces balls-that-slide liquid-bridge-washino liquid-bridge-easo)
add_cases(contact/local+contact/grain+contact/surface-friction-limit cases/friction_limit.py LABEL case
  STYLES contact/local contact/grain contact/surface dissipation RANKS 1 LONG_RANKS 2 CASES spheroids)
add_cases(surface/ellipsoid-cohesion cases/sphere_cohesion.py LABEL case STYLES surface/ellipsoid gran/insitu CASES
  poles sides pole-on-side sizes sphere-and-spheroid poles-sjkr2 sizes-sjkr2 poles-by-curvature sides-by-curvature
  sizes-by-curvature poles-under-gran spheres softened-spheres pole-on-a-plane pole-on-a-mesh
  pole-on-a-plane-by-curvature sphere-on-a-plane sphere-on-a-mesh superquadrics as-spheres-sjkr as-spheres-sjkr2
  as-spheres-edinburgh)
add_cases(surface/ellipsoid-history-columns cases/history_columns.py LABEL case
  STYLES surface/ellipsoid gran/insitu pair/gran/local CASES
  flat spheres under-gran counted behind-the-surface without-a-trace without-a-trace-under-gran
  without-a-trace-cohesive)
add_cases(surface/ellipsoid-history-columns cases/history_columns.py LABEL case STYLES surface/ellipsoid pair/gran/local
  RANKS 1 LONG_RANKS 2 CASES spheroids)

# Faces that move alone
add_cases(displacement/shear-faces cases/moving_faces.py LABEL case STYLES displacement/shear change_box RANKS 1
  LONG_RANKS 2 CASES shrink-wrapped changed-periodic changed-tilt)
add_cases(displacement/shear-faces cases/moving_faces.py LABEL case STYLES displacement/shear change_box CASES
  shrink-wrapped-grains-at-rest shrink-wrapped-all-around shrink-wrapped-with-minimum shrink-wrapped-above
  in-a-shear-flow changed changed-and-back changed-with-remap changed-periodic-with-remap changed-tilt-with-remap
  changed-boundary)
add_cases(fluctuation+layering-faces cases/moving_faces.py LABEL case STYLES fluctuation layering RANKS 1 LONG_RANKS 2
  CASES top-layer)
add_cases(gran/insitu-faces cases/moving_faces.py LABEL case STYLES gran/insitu run/guard setup/memory CASES
  neutral-with-minimum neutral-changed-beyond-grains neutral-notices-periodic)
add_cases(gran/insitu-faces cases/moving_faces.py LABEL case STYLES gran/insitu setup/memory RANKS 1 LONG_RANKS 2 CASES
  neutral-shrink-wrapped neutral-restart)

# Data files
add_cases(superquadric-data-file cases/data_files.py LABEL case STYLES superquadric RANKS 1 LONG_RANKS 2 CASES
  there-and-back there-and-back-triclinic there-and-back-after-steps by-hand-18-columns)
add_cases(property/atom-of-superquadrics cases/data_files.py LABEL case
  STYLES property/atom superquadric RANKS 1 2 CASES
  property-atom)
add_cases(granular_superquadric-data-file cases/data_files.py LABEL case STYLES granular_superquadric CASES
  by-the-other-name)
add_cases(superquadric-data-file cases/data_files.py LABEL case STYLES superquadric CASES
  columns-of-file by-hand-11-columns by-hand-14-columns by-hand-15-columns by-hand-with-comments spin-of-file
  spin-of-other-moments spheres)
add_cases(superquadric-data-file cases/inserted.py LABEL case STYLES superquadric CASES inserted)
add_cases(build-mends cases/inserted.py LABEL case STYLES build RANKS 1 LONG_RANKS 2 CASES screen-none)

# The tests themselves
add_cases(suite-starts cases/starts.py LABEL case STYLES suite CASES
  alone-shares-no-directory mpirun-has-its-own killed-leaves-nothing note-of-a-killed-one
  only-our-errors-count rows-are-counted-from-the-first-step)
add_cases(suite-starts cases/starts.py LABEL long STYLES suite CASES side-by-side)
add_cases(suite-order cases/suite.py LABEL case STYLES suite CASES
  every-style-has-tests names-begin-with-a-style unknown-word-refused short-words what-works-where)
add_cases(study-runs cases/study_runs.py LABEL case STYLES study LONG_RANKS 1 2 4 CASES longer-strain-continues-basic)
add_cases(build-bare-debian cases/bare_debian.py LABEL long STYLES build CASES
  demos-are-equal tests-on-bookworm tests-on-trixie package-of-bookworm package-of-trixie clang-of-trixie)
add_cases(build-containers cases/containers.py LABEL case STYLES build CASES same-in-both)
add_cases(build-containers cases/containers.py LABEL case STYLES build LONG_RANKS 1 CASES build-gets-its-files)
add_cases(build-job-scripts cases/job_scripts.py LABEL long STYLES build CASES slurm pbs sge)

# What grains do at walls
add_cases(wall/contact cases/wall_contact.py LABEL case STYLES wall/contact wall/gran RANKS 1 2 LONG_RANKS 4 CASES drum)
add_cases(wall/contact cases/wall_contact.py LABEL case STYLES wall/contact wall/gran RANKS 1 LONG_RANKS 2 4 CASES
  balance mesh-stress)
add_cases(wall/contact cases/wall_contact.py LABEL case STYLES wall/contact wall/gran RANKS 1 LONG_RANKS 2
  CASES impacts)
add_cases(wall/contact cases/wall_contact.py LABEL case STYLES wall/contact wall/gran CASES
  couple weight rows-by-name power-of-a-plane losses areas bounded impacts-resumed)
add_cases(wall/triangle cases/wall_triangle.py LABEL case STYLES wall/triangle wall/contact RANKS 1 2 LONG_RANKS 4 CASES
  rows)
add_cases(wall/triangle cases/wall_triangle.py LABEL case STYLES wall/triangle wall/contact RANKS 1 LONG_RANKS 2 4 CASES
  wear)

# A box that fix press/strain would make too small
add_cases(press/strain-small-box cases/small_box.py LABEL case STYLES press/strain gran/insitu RANKS 1 LONG_RANKS 2 4
  CASES refused warned)
add_cases(press/strain-small-box cases/small_box.py LABEL case STYLES press/strain gran/insitu CASES
  discs only-what-is-certain large-enough forecast-comes-true)

# Standard numbers of a state
add_cases(packing cases/packing_measures.py LABEL case STYLES packing RANKS 1 LONG_RANKS 2 4 CASES
  spheres oblate chains at-walls)
add_cases(packing cases/packing_clumps.py LABEL case STYLES packing RANKS 1 LONG_RANKS 2 4 CASES clumps)
add_cases(packing cases/packing_clumps.py LABEL case STYLES packing RANKS 1 LONG_RANKS 2 4 CASES
  rigid-refused clumps-between-walls)
add_cases(packing cases/packing_measures.py LABEL case STYLES packing RANKS 1 LONG_RANKS 2 4 CASES
  prolate blocky discs of-a-group in-regions empty-group inertial-number)
add_cases(contact/force cases/contact_force.py LABEL case STYLES contact/force contact/local RANKS 1 2 LONG_RANKS 4
  CASES prolate)
add_cases(contact/force cases/contact_force.py LABEL case STYLES contact/force contact/local RANKS 1 LONG_RANKS 2 4
  CASES spheres chains equal-forces at-walls clumps)
add_cases(contact/force cases/contact_force.py LABEL case STYLES contact/force contact/local RANKS 1 LONG_RANKS 2 4
  CASES trajectory-untouched oblate superquadric cohesive of-types discs in-a-region of-a-group empty-group)

# Fields on grids
add_cases(field/write cases/field_files.py LABEL case STYLES field/write RANKS 1 2 LONG_RANKS 4 CASES averages)
add_cases(field/write cases/field_files.py LABEL case STYLES field/write RANKS 1 LONG_RANKS 2 4 CASES untouched
  between-runs refused)
add_cases(field cases/field.py LABEL case STYLES field RANKS 1 LONG_RANKS 2 4 CASES
  sheared-spheres sheared-ellipsoids flipping-box laboratory walls)
add_cases(field cases/field.py LABEL case STYLES field LONG_RANKS 1 2 4 CASES gaussian)
add_cases(field cases/field.py LABEL case STYLES field RANKS 1 LONG_RANKS 2 4 CASES lucy rings-in-a-drum empty-cells
  trajectory-untouched)
add_cases(field cases/field.py LABEL case STYLES field RANKS 1 LONG_RANKS 2 4 CASES which-walls types group
  order-of-columns by-region clumps-refused on-faces other-region mixture-warned-of)
add_cases(field cases/field.py LABEL case STYLES field LONG_RANKS 1 2 4 CASES rings-in-a-periodic-box two-dimensions)
add_cases(field+stress/contact+packing-sums cases/field.py LABEL case STYLES field stress/contact fabric dissipation
  packing nematic RANKS 1 2 LONG_RANKS 4 CASES sums-ellipsoids)
add_cases(field+stress/contact+packing-sums cases/field.py LABEL case STYLES field stress/contact fabric dissipation
  packing nematic RANKS 1 LONG_RANKS 2 4 CASES sums sums-between-walls)
add_cases(field cases/field.py LABEL case STYLES field CASES
  oracle-clipped-as-sampled oracle-by-hand oracle-weights-of-kernels oracle-sums oracle-sums-ellipsoids
  oracle-sums-between-walls)
add_cases(field cases/field_balances.py LABEL case STYLES field RANKS 1 2 LONG_RANKS 4 CASES cold-sheared-box)
add_cases(field cases/field_balances.py LABEL case STYLES field RANKS 1 LONG_RANKS 2 4 CASES cold-affine cold-rotation
  cold-rotation-in-rings mass weight silo under-a-plate)
add_cases(field cases/field_balances.py LABEL case STYLES field RANKS 1 LONG_RANKS 2 4 CASES
  cold-layers momentum momentum-sheared momentum-gaussian)

# Includes between the folders of src/
add_cases(suite-floors cases/floors.py LABEL case STYLES suite CASES
  includes-go-down small-tree-passes up-refused up-by-angle-brackets-refused beside-refused host-in-core-refused
  mpi-in-core-refused two-of-one-name-refused unknown-folder-refused)

# Outputs have names
set(with_outputs stress/contact fabric contact/direction contact/surface contact/grain contact/local contact/solver
  wall/contact wall/triangle
  contact/force packing
  displacement/shear dissipation energy/ledger fluctuation layering nematic velocity/correlation velocity/memory
  property/atom press/strain press/wall)
add_cases(every-style-outputs cases/outputs_declared.py LABEL case STYLES outputs ${with_outputs} RANKS 1 2
  CASES every-number)
add_cases(every-style-outputs cases/outputs_declared.py LABEL case STYLES outputs ${with_outputs} CASES
  norm json-is-made pages declared-in-words)
add_cases(outputs-variables cases/outputs.py LABEL case STYLES outputs stress/contact RANKS 1 LONG_RANKS 2 CASES
  read-everywhere announced lasting printed-once)
add_cases(outputs-variables cases/outputs.py LABEL case STYLES outputs stress/contact dissipation press/strain CASES
  prefixes)
add_cases(outputs-variables cases/outputs.py LABEL case
  STYLES outputs fabric contact/local property/atom contact/direction stress/contact
  CASES chosen listed-only users-own given-again)

# Walls: what one grain at a wall does, in closed form, and the balance of the forces of walls with the stress
add_cases(stress/contact-at-walls cases/wall_analytic.py LABEL case
  STYLES stress/contact wall/gran dissipation energy/ledger
  RANKS 1 LONG_RANKS 2
  CASES bouncing-ball-0.1 bouncing-ball-0.3 bouncing-ball-0.5 bouncing-ball-0.7 bouncing-ball-0.9 sliding-block-30
  sliding-block-60 slipping-ball-45 slipping-ball-60 spinning-ball-rolls thrown-ball-rolls backspin full-box plates
  spheroid-lies-ellipsoid spheroid-lies-superquadric spheroid-stands-ellipsoid spheroid-stands-superquadric
  block-in-a-drum)

# Tools: dumps read, and converted for ParaView and OVITO
add_cases(tools-dumps cases/tools_dumps.py LABEL case STYLES tools CASES
  many-snapshots many-files side-by-side boxes cut-off refusals words-and-frames of-a-run)
add_cases(tools-convert cases/tools_convert.py LABEL case STYLES tools CASES
  glyph-tensors-polydisperse glyph-tensors-prolate glyph-tensors-oblate glyph-tensors-triaxial surfaces boxy-surfaces
  all-columns other-names series walls refusals)
add_cases(tools-convert-contacts cases/tools_convert_contacts.py LABEL case STYLES tools contact/local
  RANKS 1 LONG_RANKS 2 CASES spheroids)
add_cases(tools-convert-contacts cases/tools_convert_contacts.py LABEL case STYLES tools contact/local CASES
  spheres discs with-walls chosen-columns across-a-face page refusals)
add_cases(tools-convert-ovito cases/tools_convert_ovito.py LABEL case STYLES tools CASES
  page conversion spheres refusals)
add_cases(tools-paraview cases/tools_paraview.py LABEL case STYLES tools LONG_RANKS 1 CASES grains contacts)
# Tools: pictures and films
add_cases(tools-selection cases/tools_selection.py LABEL case STYLES tools CASES same-as-python refused)
add_cases(tools-render cases/tools_render.py LABEL case STYLES tools CASES
  outline-prolate outline-triaxial outline-in-perspective up-axis views colour-map vectors-and-kinds alignment
  two-dimensions superquadrics)
add_cases(tools-render-scene cases/tools_render_scene.py LABEL case STYLES tools CASES
  walls wall-edges primitives cuts wall-parts wrapped boxes-and-arrows chains chains-across-faces see-through needs)
add_cases(tools-render-scene cases/tools_render_scene.py LABEL case STYLES tools contact/local
  RANKS 1 LONG_RANKS 2 CASES chains-of-a-run)
add_cases(tools-render-film cases/tools_render_film.py LABEL case STYLES tools LONG_RANKS 1 CASES gif progress
  walls-that-move)
add_cases(tools-render-film cases/tools_render_film.py LABEL case STYLES tools CASES one-view-at-a-time same-look
  one-step missing-programs refusals scene-file)
add_cases(tools-render-film cases/tools_render_film.py LABEL case STYLES tools LONG_RANKS 1 CASES mp4)
add_cases(tools-render-page cases/tools_render_page.py LABEL case STYLES tools contact/local LONG_RANKS 1 CASES
  commands)
add_cases(tools-render-page cases/tools_render_page.py LABEL case STYLES tools contact/local CASES gallery)

# Format of the files, and what the tools that look for faults say of them
add_cases(documentation cases/documentation.py LABEL case STYLES documentation CASES
  messages-are-those-of-the-sources questions-are-listed tutorials-have-the-tested-numbers gallery site
  faults-are-found page-without-a-place-refused lists-of-commonmark script-refuses)
add_cases(documentation-browser cases/browser.py LABEL case STYLES documentation LONG_RANKS 1 CASES
  pages-fit search-finds)
add_cases(documentation-commonmark cases/commonmark.py LABEL case STYLES documentation LONG_RANKS 1 CASES
  blocks-of-pages)
add_cases(suite-style cases/style.py LABEL case STYLES suite style CASES clang-format black flake8 imports citation)
add_cases(suite-style cases/style.py LABEL long STYLES suite style CASES clang-tidy)

# Two dimensions: discs, whatever the box's depth is
add_cases(every-style-two-dimensions cases/two_dimensions.py LABEL case STYLES ALL RANKS 1 LONG_RANKS 2 4 CASES
  any-depth)
add_cases(every-style-two-dimensions cases/two_dimensions_runs.py LABEL case STYLES ALL LONG_RANKS 2 4 CASES
  decompositions)
add_cases(stress/contact-two-dimensions cases/two_dimensions.py LABEL case STYLES stress/contact
  RANKS 1 LONG_RANKS 2 4 CASES stress lattice)
add_cases(fluctuation+layering+contact/direction-two-dimensions cases/two_dimensions.py LABEL case STYLES fluctuation
  layering contact/direction RANKS 1 LONG_RANKS 2 4 CASES motion)
add_cases(dissipation+nematic+contact/grain-two-dimensions cases/two_dimensions.py LABEL case STYLES dissipation nematic
  contact/grain contact/local RANKS 1 LONG_RANKS 2 4 CASES losses)
add_cases(fabric-two-dimensions cases/two_dimensions.py LABEL case STYLES fabric RANKS 1 LONG_RANKS 2 4 CASES fabric)
add_cases(velocity/correlation-two-dimensions cases/two_dimensions.py LABEL case STYLES velocity/correlation RANKS 1
  LONG_RANKS 2 4 CASES correlation)
add_cases(energy/ledger-two-dimensions cases/two_dimensions_runs.py LABEL case STYLES energy/ledger
  RANKS 1 LONG_RANKS 2 4 CASES ledger)
add_cases(press/strain-two-dimensions cases/two_dimensions_runs.py LABEL case STYLES press/strain
  RANKS 1 LONG_RANKS 2 4 CASES pressure)
add_cases(displacement/shear-two-dimensions cases/two_dimensions_runs.py LABEL case STYLES displacement/shear
  RANKS 1 LONG_RANKS 2 4 CASES displacement)
add_cases(wall/contact+stress/contact-two-dimensions cases/two_dimensions_runs.py LABEL case
  STYLES wall/contact stress/contact wall/gran RANKS 1 LONG_RANKS 2 4 CASES walls ring)
add_cases(stress/contact-two-dimensions cases/two_dimensions_runs.py LABEL case STYLES stress/contact
  RANKS 1 LONG_RANKS 2 4 CASES regions)
add_cases(gran/insitu-two-dimensions cases/two_dimensions_runs.py LABEL case STYLES gran/insitu
  RANKS 1 LONG_RANKS 2 4 CASES in-parts)
# What is measured: the shared keywords
set(scoped stress/contact dissipation fabric contact/grain)
add_cases(stress/contact+dissipation+fabric-scope cases/scopes.py LABEL case STYLES ${scoped} RANKS 1 LONG_RANKS 4 CASES
  rows-by-types)
add_cases(stress/contact+dissipation+fabric-scope cases/scopes.py LABEL case STYLES ${scoped} RANKS 1 4 CASES
  chosen-types)
add_cases(stress/contact-scope cases/scopes.py LABEL case STYLES stress/contact RANKS 1 LONG_RANKS 4 CASES
  planes-and-pressures volumes whole-box-warned-of)
add_cases(nematic-scope cases/scopes.py LABEL case STYLES nematic RANKS 1 LONG_RANKS 4 CASES
  mixtures-of-shapes angles-in-planes)
add_cases(stress/contact+fabric+dissipation-region cases/regions.py LABEL case STYLES stress/contact fabric dissipation
  RANKS 1 4 LONG_RANKS 2 CASES partition-of-a-sheared-box)
add_cases(stress/contact+fabric+dissipation-region cases/regions.py LABEL case STYLES stress/contact fabric dissipation
  RANKS 1 LONG_RANKS 2 4 CASES partition-between-walls)
add_cases(stress/contact+nematic+contact/grain-region cases/regions.py LABEL case STYLES stress/contact nematic
  contact/grain dissipation RANKS 1 LONG_RANKS 2 4 CASES places)
add_cases(stress/contact-region cases/regions.py LABEL case STYLES stress/contact RANKS 1 LONG_RANKS 2 4 CASES
  volumes-add-up nothing-there)
add_cases(contact/direction+contact/surface+contact/local-region cases/regions.py LABEL case STYLES contact/direction
  contact/surface contact/local RANKS 1 LONG_RANKS 2 4 CASES bins-and-rows)
add_cases(velocity/correlation-region cases/flows.py LABEL case STYLES velocity/correlation RANKS 1 LONG_RANKS 2
  CASES correlation-in-a-region)
add_cases(stress/contact+fabric+fluctuation-region cases/regions.py LABEL case
  STYLES stress/contact fabric fluctuation RANKS 1 LONG_RANKS 2 4 CASES without-set-up)
add_cases(stress/contact+fabric-region cases/regions.py LABEL case STYLES stress/contact fabric dissipation
  RANKS 1 LONG_RANKS 2 CASES refused)
add_cases(stress/contact-region cases/region_shapes.py LABEL case STYLES stress/contact RANKS 1 LONG_RANKS 2 4 CASES
  shapes)
add_cases(stress/contact-region cases/region_shapes.py LABEL case STYLES stress/contact RANKS 1 LONG_RANKS 2 4 CASES
  closed-forms faces-that-follow two-dimensions between-runs)
add_cases(stress/contact+fabric+contact/grain-region cases/region_shapes.py LABEL case
  STYLES stress/contact fabric contact/grain RANKS 1 LONG_RANKS 2 CASES half-infinite-prism)

# Clumps
set(of_clumps stress/contact fluctuation displacement/shear velocity/correlation velocity/memory layering contact/grain)
add_cases(stress/contact+fluctuation+displacement/shear-clumps cases/clumps.py LABEL case STYLES ${of_clumps} RANKS 1
  LONG_RANKS 2 4 CASES as-grains between-walls)
add_cases(stress/contact+fluctuation+displacement/shear-clumps cases/clumps.py LABEL case STYLES ${of_clumps} LONG_RANKS
  2 1 4 CASES crosses-faces trajectory-untouched)
add_cases(dissipation+fabric+contact/direction-clumps cases/clumps.py LABEL case
  STYLES dissipation fabric contact/direction contact/local RANKS 1 2 LONG_RANKS 4 CASES losses)
add_cases(nematic+energy/ledger+press/strain-clumps cases/clumps.py LABEL case
  STYLES nematic energy/ledger press/strain gran/insitu RANKS 1 LONG_RANKS 2 CASES refused)
add_cases(fluctuation+layering+displacement/shear-clumps cases/clumps.py LABEL case STYLES fluctuation layering
  displacement/shear velocity/memory velocity/correlation LONG_RANKS 2 1 CASES refused-of-a-part refused-bodies)

# Flows that are not the box's, groups whose grains come and go
add_cases(fluctuation-flows cases/flows.py LABEL case STYLES fluctuation RANKS 1 LONG_RANKS 2 4 CASES mean-flows)
add_cases(fluctuation-flows cases/flows.py LABEL case STYLES fluctuation RANKS 1 LONG_RANKS 2 CASES solid-rotation)
add_cases(displacement/shear-flows cases/flows.py LABEL case STYLES displacement/shear RANKS 1 2 LONG_RANKS 4 CASES
  displacements-against-flows)
add_cases(displacement/shear-flows cases/flows.py LABEL case STYLES displacement/shear RANKS 1 LONG_RANKS 2 4 CASES
  solid-turns sheared-flight)
add_cases(velocity/memory+displacement/shear-flows cases/flows.py LABEL case
  STYLES velocity/memory displacement/shear RANKS 1 2 LONG_RANKS 4 CASES grains-that-come-and-go)
add_cases(velocity/memory+displacement/shear-flows cases/flows.py LABEL case
  STYLES velocity/memory displacement/shear RANKS 1 LONG_RANKS 2 CASES over-time empty-start)
add_cases(velocity/memory+displacement/shear-time cases/passed_time.py LABEL case
  STYLES velocity/memory displacement/shear RANKS 1 LONG_RANKS 2 4 CASES goes-on)

# Other units
add_cases(every-style-units cases/units.py LABEL case STYLES ALL LONG_RANKS 1 2 CASES spheres)
add_cases(every-style-units cases/units.py LABEL case STYLES ALL RANKS 1 LONG_RANKS 2 CASES spheroids walls)

# Problems of the field whose solution is known: errors and orders of convergence (doc/verification.md)
function(add_verified script styles)
  cmake_parse_arguments(ARG "" "" "PROBLEMS;OTHERS;ON_RANKS" ${ARGN})
  list(TRANSFORM ARG_PROBLEMS APPEND -sweep OUTPUT_VARIABLE sweeps)
  set(prefix gran/insitu-verification)
  add_cases(${prefix} cases/${script}.py LABEL case STYLES ${styles} CASES ${ARG_PROBLEMS} ${ARG_OTHERS})
  add_cases(${prefix} cases/${script}.py LABEL case STYLES ${styles} LONG_RANKS 2 CASES ${ARG_ON_RANKS})
  add_cases(${prefix} cases/${script}.py LABEL case STYLES ${styles} LONG_RANKS 1 CASES ${sweeps})
  string(REPLACE verification_ "" part ${script})
  add_cases(${prefix}-${part} cases/${script}.py LABEL case STYLES ${styles} LONG_RANKS 1 CASES as-pair-style-gran)
endfunction()
add_verified(verification_normal "gran/insitu;wall/gran" PROBLEMS
  free-fall bounces-hooke bounces-hertz bounces-hertz-elastic restitution-hooke restitution-hooke-limited
  restitution-hertz elastic-impact-of-equal-spheres elastic-impact-of-unequal-spheres elastic-impact-on-a-plane
  head-on-hooke head-on-hertz stacked-hooke stacked-hertz stacked-hertz-elastic ON_RANKS head-on-hertz)
add_verified(verification_friction "gran/insitu;wall/gran;surface/ellipsoid" PROBLEMS
  slip-to-roll slip-to-roll-of-ellipsoids slip-to-roll-on-a-mesh oblique-on-a-plane oblique-on-a-mesh oblique-damped
  oblique-damped-along-the-normal oblique-of-two-spheres
  OTHERS kharaz coulomb ON_RANKS oblique-of-two-spheres)
add_verified(verification_forces "gran/insitu;wall/gran" PROBLEMS spin-down-cdt rolling-cdt spin-down-epsd2 settling
  OTHERS pull-off-sjkr pull-off-sjkr2 pull-off-jkr pulled-sjkr pulled-sjkr2 ON_RANKS pull-off-sjkr)
add_verified(verification_spheroids "gran/insitu;surface/ellipsoid;nve/spheroid;wall/gran" PROBLEMS
  elastic-impact-prolate-poles elastic-impact-prolate-sides elastic-impact-oblate-faces
  elastic-impact-oblate-edge-on-prolate-pole elastic-impact-triaxial-on-a-plane elastic-impact-superquadric
  leaning-prolate leaning-oblate leaning-on-a-mesh leaning-superquadric collision-ellipsoid collision-superquadric
  precession-spheroid precession-superquadric rest-ellipsoid rest-superquadric ON_RANKS leaning-prolate)

add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu surface/ellipsoid wall/gran CASES
  neck neck-equal neck-ellipsoids points-ellipsoid sieve)
add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu surface/ellipsoid wall/gran
  LONG_RANKS 1 CASES neck-superquadrics neck-one-by-one points)
add_cases(gran/insitu-time-level cases/time_level.py LABEL long STYLES gran/insitu CASES neck-tiny neck-hundred)
add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu surface/ellipsoid CASES order-normal
  order-normal-damped order-tangential order-rolling order-all order-all-damped order-ellipsoids order-cylinder
  order-cylinder-ellipsoid lanes-spheres lanes-spheroids lanes-balls lanes-viscous)
add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu surface/ellipsoid LONG_RANKS 1 CASES
  order-spheroids)
add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu surface/ellipsoid RANKS 2 LONG_RANKS
  4 CASES ranks-spheroids)
add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu surface/ellipsoid LONG_RANKS 2 4
  CASES ranks-spheres)
add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu wall/gran setup/memory read_restart
  RANKS 1 LONG_RANKS 2 4 CASES restart-spheres restart-spheroids)
add_cases(gran/insitu-time-level cases/time_level.py LABEL case STYLES gran/insitu wall/gran setup/memory CASES
  repeated-spheres repeated-spheroids)
