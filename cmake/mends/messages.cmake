# Messages that get lost, and messages about a wrong name or index that do not say which. src/HOST/host_messages.h has what is put in.

# As mend(), in a file that then includes our header.
function(mend_message file old new why)
  set(mends ${HOST_MENDS})
  mend(${file} "${old}" "${new}" "${why}")
  if(NOT mends STREQUAL "${HOST_MENDS}")
    set(mends ${HOST_MENDS})
    mend(${file} "#include \"error.h\"\n" "#include \"error.h\"\n#include \"host_messages.h\"\n" "")
    set(HOST_MENDS ${mends} PARENT_SCOPE)
    set(MENDED_FILES ${MENDED_FILES} PARENT_SCOPE)
  endif()
endfunction()

# What ends a run: MPI_Abort comes before any flush, other ranks than the first know no log file, and `-screen none` leaves nothing.
set(lost "an error is lost where the screen is a file, a pipe or none")
mend_message(error.cpp "\n    if (logfile) fprintf(logfile,\"ERROR: %s (%s:%d)\\n\",str,file,line);"
             "\n    grainscope::last_words(lmp,\"ERROR: %s (%s:%d)\\n\",str,file,line);" "${lost}")
mend_message(error.cpp "        if (logfile) fprintf(logfile,\"ERROR: " "        grainscope::last_words(lmp,\"ERROR: " "likewise, of a fix or a compute")
mend_message(error.cpp "\n  MPI_Abort(world,1);" "\n  grainscope::last_words(lmp,\"ERROR on proc %d: %s (%s:%d)\\n\",me,str,file,line);\n  MPI_Abort(world,1);"
             "likewise, of one rank")
mend_message(error.cpp "\n\n  MPI_Abort(universe->uworld,1);"
             "\n\n  grainscope::last_words(lmp,\"ERROR on proc %d: %s (%s:%d)\\n\",universe->me,str,file,line);\n  MPI_Abort(universe->uworld,1);"
             "likewise, when the program starts")
mend_message(error.cpp "\n    const char * special_msg = specialMessages_.generate_message();\n    if(special_msg)\n    {\n        if (universe->uscreen)"
             "\n    grainscope::last_words(lmp,\"ERROR: %s (%s:%d)\\n\",str,file,line);
    const char * special_msg = specialMessages_.generate_message();\n    if(special_msg)\n    {\n        if (universe->uscreen)"
             "likewise, of all ranks when the program starts")
mend_message(lammps.cpp "\n  // parse input switches\n" "\n  grainscope::begin_messages(this);\n\n  // parse input switches\n"
             "lines wait in a buffer until a run ends, and are lost when it aborts")
mend_message(lammps.cpp "\n  // make universe and single world the same, since no partition switch\n"
             "\n  grainscope::log_goes_to(logflag ? arg[logflag] : \"log.liggghts\");
  grainscope::write_by_line(universe->uscreen);
  grainscope::write_by_line(universe->ulogfile);
\n  // make universe and single world the same, since no partition switch\n" "likewise, of screen and log file")
mend_message(input.cpp "\n    if (universe->nworlds == 1) universe->ulogfile = logfile;\n  }\n"
             "\n    if (universe->nworlds == 1) universe->ulogfile = logfile;\n    grainscope::write_by_line(logfile);\n  }\n  grainscope::log_goes_to(arg[0]);\n"
             "likewise, of the log file that a command names")

# Which compute, which index, and what there is.
mend_message(error.cpp "\n  if (me == 0) {\n    if (screen) fprintf(screen,\"ERROR: %s (%s:%d)\\n\",str,file,line);"
             "\n  if (me == 0) {\n    const std::string told = grainscope::explained(lmp,str);\n    str = told.c_str();
    if (screen) fprintf(screen,\"ERROR: %s (%s:%d)\\n\",str,file,line);"
             "a wrong name or index is not named, nor what there is instead")
mend_message(variable.cpp "\ndouble Variable::evaluate(char *str, Tree **tree)\n{\n"
             "\ndouble Variable::evaluate(char *str, Tree **tree)\n{\n  const grainscope::FormulaUnderway underway(str);\n" "likewise, in a formula")

# `c_s[*]`, `c_s[2x]`, `c_s[0]` and `c_s[1][2]` are taken for something else: the number at the beginning, or none at all.
foreach(name compute_atom_molecule compute_reduce compute_slice dump_custom dump_local dump_particle fix_ave_atom fix_ave_correlate fix_ave_histo
        fix_ave_spatial fix_ave_time fix_store_state)
  mend_message(${name}.cpp " = atoi(ptr+1);" " = grainscope::index_in_brackets(lmp,ptr);" "an index that is none is taken for another")
endforeach()
