# What waits for a step that `reset_timestep` has renumbered.

# A fix that averages expects its next sample in a step of the old numbers: with lower numbers its rows end without a
# message. Its averages begin again instead, as when it is defined. (`rerun` and `read_dump` go to higher numbers.)
foreach(name atom correlate histo spatial time)
  set(missed "  if (ntimestep > nvalid) error->all(FLERR,\"Fix ave/${name} missed timestep\");")
  set(begin "    irepeat = 0;\n")
  if(name STREQUAL "correlate")
    set(begin "    lastindex = -1;\n    firstindex = 0;\n    nsample = 0;
    for (int i = 0; ave == ONE && i < nrepeat; i++) {
      count[i] = 0;
      for (int j = 0; j < npair; j++) corr[i][j] = 0.0;
    }\n")
  endif()
  set(why "after reset_timestep to a lower step fix ave/${name} takes no more samples")
  mend(fix_ave_${name}.h "  void reset_timestep(bigint);" "  void reset_timestep(bigint,bigint);" "${why}")
  mend(fix_ave_${name}.cpp "::reset_timestep(bigint ntimestep)\n{\n${missed}"
       "::reset_timestep(bigint ntimestep, bigint before)\n{\n  if (ntimestep < before) {
${begin}    nvalid = nextvalid();\n    modify->addstep_compute_all(nvalid);\n  }\n${missed}" "likewise")
endforeach()

# The steps for which computes are announced are forgotten before others announce theirs, and the next step of every fix
# that acts at intervals is announced.
set(loop "  for (int i = 0; i < modify->ncompute; i++)
    if (modify->compute[i]->timeflag) modify->compute[i]->clearstep();\n")
set(output "  output->reset_timestep(ntimestep);\n")
set(reset "    modify->fix[i]->reset_timestep(ntimestep,oldtimestep);\n")
mend(update.cpp "${loop}" "" "steps that are announced to computes in reset_timestep are forgotten")
mend(update.cpp "${output}" "${loop}\n${output}" "likewise")
mend(update.cpp "${reset}" "${reset}    const bigint every = modify->fix[i]->nevery;
    if (every > 0) modify->addstep_compute_all((ntimestep/every + 1)*every);\n"
     "after reset_timestep the next step of fix print and others is not announced to computes")
