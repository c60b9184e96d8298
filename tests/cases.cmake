add_cases(pair-bitwise-equal cases/pair_bitwise.py LABEL case RANKS 1 2 CASES
  spheres spheres-as-superquadrics spheroid-0.33 spheroid-1.5 spheroid-3 polydisperse two-types)
add_cases(pair-bitwise-equal cases/pair_bitwise.py LABEL case RANKS 1 CASES
  tangential-off tangential-no-history rolling-cdt hooke tangential-damping-off gaussian-curvature limit-force
  uncompiled-combination boxy-grains)
add_cases(pair cases/pair_host.py LABEL case RANKS 1 2 CASES
  pair-local-output-does-not-disturb contact-local-output-does-not-disturb restart-continues restart-of-spheres-continues
  clear-and-begin-again pair-style-again stale-springs-warned-once sinks-come-and-go virial-of-spheroids host-deck-with-walls)
add_cases(pair cases/pair_host.py LABEL case RANKS 1 CASES
  stale-springs-cured-no-warning stale-springs-of-round-superquadrics no-stale-springs-of-spheroids no-stale-springs-of-ellipsoids
  every-way-to-ask spin-of-frictionless-spheres no-springs-no-warning check-timestep-gran virial-of-plain-gran-is-wrong)
add_cases(oracle cases/measures_against_oracle.py LABEL case RANKS 1 2 CASES
  spheres spheres-in-the-open spheroid-1.5 spheroid-1.5-in-the-open spheres-through-a-flip spheroids-through-a-flip walls-not-counted)
add_cases(oracle cases/measures_against_oracle.py LABEL case RANKS 1 CASES
  spheroid-0.33-in-the-open spheroid-3-in-the-open polydisperse two-types frictionless no-history subgroup group-of-one)
add_cases(sphere-law cases/sphere_law.py LABEL case RANKS 1 CASES history-undamped no-history frictionless slippery limit-force)
add_cases(sphere-law cases/sphere_law.py LABEL case RANKS 1 2 CASES history two-types)
add_cases(same-on-ranks cases/ranks.py LABEL case RANKS 2 4 CASES spheres spheroids oblate-grains subgroup)
add_cases(same-on-ranks cases/ranks.py LABEL case RANKS 4 CASES empty-ranks empty-group)
add_cases(host-tally cases/ranks.py LABEL case RANKS 1 2 CASES stress-atom-of-spheres stress-atom-of-spheroids)
add_cases(nematic cases/nematic.py LABEL case RANKS 1 CASES
  two-of-four-along-z three-of-four-along-z all-aligned isotropic mean-angle mean-angle-is-of-lines oblate-angle
  spheres-have-no-order spheres-do-not-dilute longest-of-three-axes axis-along-body-x mean-spin)
add_cases(nematic cases/nematic.py LABEL case RANKS 2 4 CASES two-of-four-along-z three-of-four-along-z)
add_cases(collision cases/collisions.py LABEL case RANKS 1 CASES
  head-on-spheres-e-0.1 head-on-spheres-e-0.5 head-on-spheres-e-0.9 head-on-prolate-e-0.1 head-on-prolate-e-0.5 head-on-prolate-e-0.9
  head-on-oblate-e-0.1 head-on-oblate-e-0.5 head-on-oblate-e-0.9 oblique-spheres oblique-prolate single-contact)
add_cases(collision cases/collisions.py LABEL case RANKS 2 CASES head-on-prolate-e-0.5 oblique-prolate)
add_cases(sphere-law cases/sphere_law.py LABEL case RANKS 1 2 CASES under-pressure-control sheared-backward)
add_cases(press-strain cases/press_strain.py LABEL case RANKS 1 CASES
  shears-backward-as-fix-deform shears-in-xz shears-in-yz recursion-clipped recursion-clipped-by-rate recursion-every-time recursion-negative-rate
  inputs-every-strain inputs-every-time inputs-every-step holds-the-target target-zero-expands target-follows-a-variable without-shear
  momentum-kept)
add_cases(press-strain cases/press_strain.py LABEL case RANKS 1 2 CASES
  shears-as-fix-deform recursion-every-strain automatic-gain restart-continues at-the-target-nothing-moves momentum-removed
  kinetic-part-counts)
add_cases(press-strain cases/press_strain.py LABEL case RANKS 2 4 CASES same-on-ranks restart-on-other-ranks)
add_cases(ellipsoid-rows cases/ellipsoid_rows.py LABEL case RANKS 1 CASES spheroid-0.33 spheroid-3)
add_cases(ellipsoid-rows cases/ellipsoid_rows.py LABEL case RANKS 1 2 CASES spheroid-1.5)
add_cases(press-analytic cases/press_analytic.py LABEL case RANKS 1 2 CASES
  automatic-gain-compresses automatic-gain-expands automatic-gain-of-hooke given-gain)
add_cases(contact-measures cases/contact_measures.py LABEL case RANKS 1 CASES
  spheres-mu-0 spheres-mu-10 spheres-polydisperse spheroid-0.33-in-the-open spheroid-0.67-in-the-open spheroid-1-in-the-open
  spheroid-3-in-the-open spheroid-1.5-mu-0 spheroid-1.5-mu-10 spheroid-0.33 polydisperse two-types with-tangential-damping no-history
  tilted-backward subgroup group-of-one axis-along-body-x walls-not-counted units-cgs)
add_cases(contact-measures cases/contact_measures.py LABEL case RANKS 1 2 CASES
  spheres spheroid-1.5-in-the-open spheroid-1.5 spheres-through-a-flip spheroids-through-a-flip under-pressure-control)
add_cases(motion-measures cases/motion_measures.py LABEL case RANKS 1 CASES
  spheres-at-rest spheres-polydisperse spheroid-0.33 spheroid-0.67 spheroid-1 spheroid-3 triaxial tilted-backward under-pressure-control
  sheared-in-xz sheared-in-yz group-of-one)
add_cases(motion-measures cases/motion_measures.py LABEL case RANKS 1 2 CASES spheres spheroid-1.5 spheres-through-a-flip subgroup)
add_cases(contact-analytic cases/contact_analytic.py LABEL case RANKS 1 CASES
  three-of-four-along-z three-of-four-along-z-in-xz two-of-four-along-z one-of-four-less-along-x all-along-one angle-is-of-lines
  area-of-prolate-polar area-of-prolate-parametric area-of-oblate-polar area-of-oblate-parametric area-of-sphere-polar
  area-of-sphere-parametric area-about-another-axis area-about-another-axis-parametric every-bin-prolate-parametric every-bin-oblate-polar
  pole-on-equator statistics-of-spheres)
add_cases(contact-analytic cases/contact_analytic.py LABEL case RANKS 1 2 CASES
  cubic-lattice every-bin-prolate-polar every-bin-oblate-parametric opposite-bins opposite-bins-of-spheroids powers-add-up
  powers-of-spheres-add-up)
add_cases(motion-analytic cases/motion_analytic.py LABEL case RANKS 1 CASES
  rarely-asked affine-backward affine-without-stretch drifting-backward drifting-in-xz drifting-in-yz rigid lever starts-late)
add_cases(motion-analytic cases/motion_analytic.py LABEL case RANKS 1 2 CASES
  replaced-grains rarely-asked-backward affine drifting drifting-under-press-strain energies planes-of-grains random-walk later-grains remembers remembers-later-grains)
add_cases(series-measures cases/series_measures.py LABEL case RANKS 1 CASES spheroids backward backward-under-pressure-control)
add_cases(series-measures cases/series_measures.py LABEL case RANKS 1 2 CASES spheres under-pressure-control sheared-in-yz subgroup)
add_cases(correlation-measures cases/correlation_measures.py LABEL case RANKS 1 CASES
  spheres-at-rest polydisperse spheroid-0.33 spheroid-3 tilted-backward sheared-in-xz sheared-in-yz group-of-one not-periodic decays)
add_cases(correlation-measures cases/correlation_measures.py LABEL case RANKS 1 2 CASES
  spheres through-a-flip under-pressure-control subgroup running plane-wave plane-wave-on-a-mesh)
add_cases(same-everywhere cases/same_everywhere.py LABEL case RANKS 2 4 CASES spheres spheroids)
add_cases(same-everywhere cases/same_everywhere.py LABEL case RANKS 4 CASES
  oblate-grains subgroup empty-ranks empty-group restart-on-other-ranks)
add_cases(same-everywhere cases/same_everywhere.py LABEL case RANKS 1 CASES empty-group-of-spheres)
add_cases(same-everywhere cases/same_everywhere.py LABEL case RANKS 1 2 CASES
  does-not-disturb-spheres does-not-disturb-spheroids restart-refused restart-continues restart-of-spheres-continues)
add_cases(asking cases/asking.py LABEL case RANKS 1 CASES
  as-pair-gran-local-spheres as-pair-gran-local-spheroids as-pair-gran-local-oblate dumped means variables orthogonal-box)
add_cases(asking cases/asking.py LABEL case RANKS 1 2 CASES scalars vectors come-and-go)
add_cases(spheroid-motion cases/spheroid_motion.py LABEL case RANKS 1 CASES flows-as-host-1.5 flows-as-host-0.5 boxy-grains)
add_cases(spheroid-motion cases/spheroid_motion.py LABEL case RANKS 1 2 CASES
  energy-kept some-grains first-group collision-of-prolate-grains collision-of-oblate-grains inserted-grains restart-continues)
add_cases(spheroid-motion cases/spheroid_motion.py LABEL case RANKS 1 2 4 CASES
  free-flight free-flight-in-large-turns shears-as-host-1.5 shears-as-host-0.5)
add_cases(ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case RANKS 1 CASES
  spheroid-0.33 spheroid-3 spheres polydisperse frozen-grains narrow-contact-distance gaussian-curvature mean-curvature
  mean-curvature-of-mixed-shapes curvature-keywords-without-limit tangential-off tangential-no-history hooke rolling-cdt rolling-epsd2
  limit-force-undamped moved-by-nve-spheroid mixed-shapes-and-types cohesion spheres-of-five-sizes frozen-spheres softened-spheres
  rods-squeezed-by-the-box tumbling-rods-with-jumps tumbling-rods-shrink-wrapped pushed-rods shapes-set-between-runs)
add_cases(ellipsoid-bitwise-equal cases/ellipsoid_bitwise.py LABEL case RANKS 1 2 CASES
  spheroid-1.5 spheres-here-spheroids-there tumbling-rods tumbling-rods-in-a-deforming-box tumbling-rods-between-walls between-runs)
add_cases(same-on-ranks cases/ranks.py LABEL case RANKS 4 CASES ellipsoids-0.33 ellipsoids-polydisperse)
add_cases(same-on-ranks cases/ranks.py LABEL case RANKS 2 4 CASES ellipsoids-1.5 ellipsoids-3)
add_cases(same-everywhere cases/same_everywhere.py LABEL case RANKS 2 4 CASES ellipsoids)
add_cases(ellipsoid-rows cases/ellipsoid_rows.py LABEL case RANKS 1 CASES ellipsoid-0.33 ellipsoid-3)
add_cases(ellipsoid-rows cases/ellipsoid_rows.py LABEL case RANKS 2 CASES ellipsoid-1.5)
add_cases(pair cases/pair_host.py LABEL case RANKS 1 2 CASES
  virial-of-ellipsoids restart-of-ellipsoids-continues pair-local-output-does-not-disturb-ellipsoids)
add_cases(asking cases/asking.py LABEL case RANKS 1 CASES as-pair-gran-local-ellipsoids as-pair-gran-local-oblate-ellipsoids)
add_cases(ellipsoid-forces cases/ellipsoid_forces.py LABEL case RANKS 1 CASES
  spheroid-0.33 spheroid-0.5 spheroid-3 spheres polydisperse gaussian-curvature mean-curvature limit-without-curvature-keywords
  flows-on-from-the-other restart-of-prolate-grains restart-of-oblate-grains)
add_cases(ellipsoid-forces cases/ellipsoid_forces.py LABEL case RANKS 1 2 CASES spheroid-1.5 restart-before-a-flip)
add_cases(ellipsoid-forces cases/ellipsoid_forces.py LABEL case RANKS 2 CASES start-survives-a-swap)
add_cases(ellipsoid-wall cases/ellipsoid_walls.py LABEL case RANKS 1 CASES
  prolate-on-a-plane prolate-on-a-cylinder prolate-on-a-mesh oblate-on-a-plane oblate-on-a-cylinder oblate-on-a-mesh triaxial-on-a-plane
  triaxial-on-a-cylinder triaxial-on-a-mesh sphere-on-a-plane gaussian-curvature-on-a-plane gaussian-curvature-on-a-mesh
  mean-curvature-on-a-plane mean-curvature-on-a-mesh limit-alone-on-a-plane limit-alone-on-a-mesh)
add_cases(ellipsoid-wall cases/ellipsoid_walls.py LABEL case RANKS 1 2 CASES pile)
add_cases(ellipsoid-contact cases/ellipsoid_contacts.py LABEL case RANKS 1 CASES
  poles-meet poles-meet-gaussian poles-meet-mean equators-meet-gaussian equators-meet-mean flat-faces-meet-gaussian flat-faces-meet-mean
  unlike-grains-meet unlike-grains-meet-gaussian unlike-grains-meet-mean sphere-meets-pole-mean triaxial-meets-sphere-gaussian
  triaxial-meets-sphere-mean spheres-meet spheres-meet-mean limit-caps-the-radius limit-below-one-caps-spheres spheres-collide
  spheres-collide-head-on
  spheres-collide-hooke-no-history spheres-collide-rolling spheres-part-at-e concentric-spheres concentric-spheroids concentric-triaxial
  no-stale-springs no-stale-springs-of-poles host-keeps-springs host-keeps-springs-of-poles)
add_cases(ellipsoid-contact cases/ellipsoid_contacts.py LABEL case RANKS 2 CASES concentric-between-ranks)
add_cases(contact-solver cases/contact_solver.py LABEL case RANKS 1 2 4 CASES lists-and-contacts)
add_cases(contact-solver cases/contact_solver.py LABEL case RANKS 1 2 CASES add-up begins-with-the-pair-style does-not-disturb)
add_cases(contact-solver cases/contact_solver.py LABEL case RANKS 2 4 CASES same-on-ranks)
add_cases(ledger-oracle cases/ledger_oracle.py LABEL case RANKS 1 CASES
  sheared-slippery sheared-frictionless no-history polydisperse drift-kept)
add_cases(ledger-oracle cases/ledger_oracle.py LABEL case RANKS 1 2 CASES
  sheared sheared-with-tangential-damping contacts-open-and-close through-a-flip under-pressure-control)
add_cases(ledger cases/ledger.py LABEL case RANKS 1 CASES
  two-spheres two-flat two-long-3 two-triaxial two-spheres-default two-long-1.5-superquadric order-spheres order-flat order-long-1.5 order-long-3
  known-collision hooke no-history tangential-damping tangential-off limit-force curvature rolling-cdt rolling-epsd rolling-epsd2
  rolling-superquadric sheared-0.33-mu-0 sheared-0.33-mu-0.4 sheared-0.33-mu-10 sheared-1.5-mu-0 sheared-1.5-mu-0.4 sheared-1.5-mu-10
  sheared-3-mu-0 sheared-3-mu-0.4 sheared-3-mu-10 pressed-0.33 pressed-1 pressed-3 pressed-spheres pressed-dilute pressed-along-the-flow
  sheared-1-mu-0 sheared-1-mu-0.4 sheared-1-mu-10 pressed-1.5-mu-0 pressed-1.5-mu-10 energy-of-hertz energy-of-hooke energy-with-curvature
  restart-before-the-first-step asked-within-a-step overlap-of-nothing lists reopening-spheres reopening-stale-springs reopening-spheroids step-mode-is-the-trapezium superquadric)
add_cases(ledger cases/ledger.py LABEL case RANKS 1 2 CASES
  two-long-1.5 polydisperse-two-types wraps flip runs groups falling undisturbed rates-add-up restart-continues)
add_cases(ledger cases/ledger.py LABEL case RANKS 1 2 4 CASES pressed-1.5)
add_cases(ledger cases/ledger.py LABEL case RANKS 2 4 CASES same-spheres same-spheroids)
add_cases(ranges cases/ranges.py LABEL case RANKS 1 2 CASES time-step time-step-in-short-runs time-step-unseen quiet kappa clipping unstable-from-the-start profile)
add_cases(changes cases/changes.py LABEL case RANKS 1 CASES
  box-turned-triclinic grains-deleted-and-renumbered pair-style-twice-at-first compute-before-pair-style time-step-changed-between-runs
  time-step-changed-every-ten-steps loss-while-the-time-step-changes)
add_cases(changes cases/changes.py LABEL case RANKS 1 2 CASES
  box-turned-orthogonal grains-deleted grains-lost clear-starts-afresh-with-ellipsoids pair-style-twice time-step-changed-in-mid-run box-scaled)
add_cases(changes cases/changes.py LABEL case RANKS 1 2 4 CASES grains-inserted clear-starts-afresh steps-numbered-anew)
add_cases(rank-sweep cases/rank_sweep.py LABEL case RANKS 8 CASES spheres spheroids-through-a-flip superquadrics-through-a-flip)
add_cases(rank-sweep cases/rank_sweep.py LABEL long RANKS 8 CASES every-decomposition)
add_cases(decomposition cases/decomposition.py LABEL case RANKS 2 CASES on-corners-of-a-tilted-box)
add_cases(decomposition cases/decomposition.py LABEL case RANKS 4 CASES just-below-the-least-height)
add_cases(decomposition cases/decomposition.py LABEL case RANKS 4 CASES empty-ranks)
add_cases(decomposition cases/decomposition.py LABEL case RANKS 3 CASES just-above-the-least-height just-above-the-least-height-of-ellipsoids)
add_cases(decomposition cases/decomposition.py LABEL long RANKS 3 CASES migrants)
add_cases(decomposition cases/decomposition.py LABEL case RANKS 1 3 CASES
  arrive-on-the-upper-face shrinks-by-press-strain shrinks-by-fix-deform shrinks-by-change-box sheared-too-narrow
  restart-of-grains-beyond-the-box)
add_cases(decomposition cases/decomposition.py LABEL case RANKS 1 CASES host-cannot-balance)
add_cases(decomposition cases/decomposition.py LABEL long RANKS 2 3 4 8 CASES
  on-corners spheres-on-corners-of-a-tilted-box)
add_cases(decomposition cases/decomposition.py LABEL long RANKS 3 4 8 CASES on-corners-of-a-tilted-box)
add_cases(decomposition cases/decomposition.py LABEL long RANKS 2 3 8 CASES just-below-the-least-height)
add_cases(decomposition cases/decomposition.py LABEL long RANKS 2 4 8 CASES
  just-above-the-least-height just-above-the-least-height-of-ellipsoids)
add_cases(decomposition cases/decomposition.py LABEL long RANKS 8 CASES
  migrants empty-ranks arrive-on-the-upper-face shrinks-by-press-strain shrinks-by-fix-deform shrinks-by-change-box sheared-too-narrow
  restart-of-grains-beyond-the-box)
add_cases(rank-statistics cases/rank_statistics.py LABEL long RANKS 4 CASES prolate-flow)
add_cases(shuffle cases/shuffle.py LABEL case RANKS 1 CASES ellipsoids)
add_cases(shuffle cases/shuffle.py LABEL case RANKS 3 CASES spheres)
add_cases(shuffle cases/shuffle.py LABEL long RANKS 1 CASES spheres superquadrics)
add_cases(shuffle cases/shuffle.py LABEL long RANKS 4 8 CASES ellipsoids superquadrics)
add_cases(builds numerics/builds.py LABEL long RANKS 1 2 CASES spheres spheroids superquadrics)
add_cases(restart cases/restarts.py LABEL case RANKS 1 2 CASES
  split-spheroids split-through-a-flip measures-go-on exact-spheres exact-spheroids killed-a-few-times sigterm sigterm-between-short-runs)
add_cases(restart cases/restarts.py LABEL case RANKS 1 CASES
  split-spheres split-superquadrics split-of-spheres-through-a-flip split-with-rolling split-without-history split-with-gravity split-by-the-host
  split-after-no-step noticed-freezing noticed-velocities noticed-spins noticed-places noticed-box noticed-deletion noticed-time-step exact-superquadrics exact-by-the-host)
add_cases(restart cases/restarts.py LABEL case RANKS 2 CASES sigint sigterm-to-one-rank)
add_cases(restart cases/restarts.py LABEL case RANKS 4 CASES exact-spheroids sigterm sigterm-to-one-rank)
add_cases(restart cases/restarts.py LABEL long RANKS 1 2 CASES killed-spheres killed-spheroids)
add_cases(damage cases/damage.py LABEL case RANKS 1 2 CASES
  restart-cut restart-flipped newest-whole-one other-settings velocity-nan force-inf too-long-a-step lost-from-a-periodic-box)
add_cases(damage cases/damage.py LABEL case RANKS 1 CASES plain-gran-and-back may-leave-an-open-box lost-beside-an-open-face disk-full-snapshots disk-full-dump disk-full-table disk-full-log disk-full-restart)
add_cases(damage cases/damage.py LABEL long RANKS 1 CASES restart-cut-often restart-flipped-often)
add_cases(lifetimes cases/lifetimes.py LABEL case RANKS 1 CASES
  every-style-is-here computes-1000-times fixes-1000-times pair-styles-1000-times pair-styles-not-compiled-1000-times
  computes-asked-100-times fixes-run-100-times pair-styles-run-200-times)
add_cases(lifetimes cases/lifetimes.py LABEL long RANKS 2 SECONDS 600 CASES computes-asked-100-times fixes-run-100-times)
add_cases(soak cases/soak.py LABEL case RANKS 1 2 CASES spheroids-over-1e4-steps)
add_cases(soak cases/soak.py LABEL long RANKS 1 2 SECONDS 2000 CASES spheroids-over-1e5-steps)
add_cases(soak cases/soak.py LABEL long RANKS 1 SECONDS 5400 CASES spheroids-over-1e6-steps spheres-over-1e6-steps)
add_cases(study cases/study_config.py LABEL case RANKS 1 CASES
  runs-of-lists exceptions numbers-that-yaml-takes-for-words example-is-valid howto-has-the-grid-of-the-paper every-figure-is-asked-for steps-of-deck
  unknown-word empty-list no-list word-for-number
  yes-for-number negative-friction half-a-grain not-finite twice steady-beyond-strain exception-steady measure exception-shape exceptions-no-list exception-where
  exception-use exception-value output ranks)
add_cases(study-fits cases/study_fits.py LABEL case RANKS 1 CASES
  friction-law fraction-law power-law without-errors decay refused curves-that-do-not-bend crossing level-set laws-of-grid laws-of-shape seeds-and-sizes agreement
  published-of-grid)
add_cases(study cases/study_runs.py LABEL case RANKS 1 2 CASES killed-run-continues longer-strain-continues)
add_cases(study cases/study_runs.py LABEL case RANKS 1 CASES
  one-at-a-time stopped-run-has-not-ended first-restart-cut no-restart-whole other-variables-refused part-must-be-named reason-is-told means-of-files table-holds-everything)
add_cases(study cases/study_workflow.py LABEL case RANKS 1 SECONDS 600 CASES
  failing-runs-do-not-stop-others study-goes-on basic-measures bad-configuration)
add_cases(study cases/study_slurm.py LABEL long RANKS 1 SECONDS 900 CASES slurm-grid)
add_cases(displacement/shear-faces cases/moving_faces.py LABEL case STYLES displacement/shear RANKS 1 2 CASES
  shrink-wrapped changed-periodic changed-tilt)
add_cases(displacement/shear-faces cases/moving_faces.py LABEL case STYLES displacement/shear RANKS 1 CASES
  shrink-wrapped-grains-at-rest shrink-wrapped-all-around shrink-wrapped-with-minimum shrink-wrapped-above in-a-shear-flow changed changed-and-back
  changed-with-remap changed-periodic-with-remap changed-tilt-with-remap changed-boundary)
add_cases(fluctuation-faces cases/moving_faces.py LABEL case STYLES fluctuation layering RANKS 1 2 CASES top-layer)
add_cases(gran/insitu-faces cases/moving_faces.py LABEL case STYLES gran/insitu run/guard RANKS 1 CASES
  neutral-with-minimum neutral-changed-beyond-grains neutral-notices-periodic)
add_cases(gran/insitu-faces cases/moving_faces.py LABEL case STYLES gran/insitu RANKS 1 2 CASES neutral-shrink-wrapped neutral-restart)
