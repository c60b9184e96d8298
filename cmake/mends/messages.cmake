# Messages that get lost, and messages about a wrong name or index that do not say which. The functions that the mends
# call are in src/HOST/host_messages.h.

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

# Errors end a run by MPI_Abort, before any stream is flushed; only rank 0 has the log file; `-screen none` leaves no
# message.
set(said "str,file,line);\n")
set(all "\"ERROR: %s (%s:%d)\\n\",${said}")
set(one "\"ERROR on proc %d: %s (%s:%d)\\n\"")
set(special "    const char * special_msg = specialMessages_.generate_message();\n    if(special_msg)\n    {\n")
mend_message(error.cpp "\n    if (logfile) fprintf(logfile,${all}" "\n    grainscope::last_words(lmp,${all}"
             "an error message is lost when the screen is a file, a pipe or none")
mend_message(error.cpp "        if (logfile) fprintf(logfile,\"ERROR: " "        grainscope::last_words(lmp,\"ERROR: "
             "an error message of a fix or compute is lost likewise")
mend_message(error.cpp "\n  MPI_Abort(world,1);" "\n  grainscope::last_words(lmp,${one},me,${said}  MPI_Abort(world,1);"
             "an error message of one rank is lost likewise")
mend_message(error.cpp "\n\n  MPI_Abort(universe->uworld,1);"
             "\n\n  grainscope::last_words(lmp,${one},universe->me,${said}  MPI_Abort(universe->uworld,1);"
             "an error message at the start of the program is lost likewise")
mend_message(error.cpp "\n${special}        if (universe->uscreen)"
             "\n    grainscope::last_words(lmp,${all}${special}        if (universe->uscreen)"
             "an error message of all ranks at the start is lost likewise")
mend_message(lammps.cpp "\n  // parse input switches\n"
             "\n  grainscope::begin_messages(this);\n\n  // parse input switches\n"
             "lines stay in a buffer until a run ends, and are lost when it aborts")
set(one_world "\n  // make universe and single world the same, since no partition switch\n")
mend_message(lammps.cpp "${one_world}" "
  grainscope::screen_goes_to(screenflag ? arg[screenflag] : \"none\");
  grainscope::log_goes_to(logflag ? arg[logflag] : \"log.liggghts\");
  grainscope::write_by_line(universe->uscreen);
  grainscope::write_by_line(universe->ulogfile);
${one_world}" "lines of the screen and the log file are lost likewise")
set(log_opened "\n    if (universe->nworlds == 1) universe->ulogfile = logfile;\n")
mend_message(input.cpp "${log_opened}  }\n"
             "${log_opened}    grainscope::write_by_line(logfile);\n  }\n  grainscope::log_goes_to(arg[0]);\n"
             "lines of the log file that a command names are lost likewise")

# Messages say which compute and which index is wrong, and what exists.
mend_message(error.cpp "\n  if (me == 0) {\n    if (screen) fprintf(screen,${all}" "
  if (me == 0) {
    const std::string told = grainscope::explained(lmp,str);
    str = told.c_str();
    if (screen) fprintf(screen,${all}" "messages name neither the wrong name or index nor what exists")
set(evaluate "\ndouble Variable::evaluate(char *str, Tree **tree)\n{\n")
mend_message(variable.cpp "${evaluate}" "${evaluate}  const grainscope::FormulaUnderway underway(str);\n"
             "messages about a formula likewise")

# thermo_style names variables, which are looked up when a run begins.
mend_message(thermo.cpp "    if (ivariable < 0)\n      error->all(FLERR,\"Could not find thermo variable name\");" "
    if (ivariable < 0) {
      const std::string name = std::string(\"v_\") + id_variable[i];
      const grainscope::FormulaUnderway underway(name.c_str());
      error->all(FLERR,\"Could not find thermo variable name\");
    }" "messages about a variable of thermo_style likewise")

# LIGGGHTS reads `c_s[*]`, `c_s[2x]`, `c_s[0]` and `c_s[1][2]` by the number at the beginning, or by none.
foreach(name compute_atom_molecule compute_reduce compute_slice dump_custom dump_local dump_particle fix_ave_atom
        fix_ave_correlate fix_ave_histo fix_ave_spatial fix_ave_time fix_store_state)
  mend_message(${name}.cpp " = atoi(ptr+1);" " = grainscope::index_in_brackets(lmp,ptr);"
               "text in brackets that is not an index is read as another index")
endforeach()

# `fix ave/histo` uses a compute, fix or variable before it checks that it exists, and checks only the first.
foreach(type Compute Fix)
  string(TOLOWER ${type} name)
  set(find "modify->find_${name}(ids")
  mend(fix_ave_histo.cpp "\n      ${type} *${name} = modify->${name}[${find}[0])];" "
      if (${find}[i]) < 0) error->all(FLERR,\"${type} ID for fix ave/histo does not exist\");
      ${type} *${name} = modify->${name}[${find}[i])];" "a ${name} that does not exist crashes fix ave/histo")
endforeach()
set(find "\n      int ivariable = input->variable->find(ids[i]);\n")
set(equal "      if (input->variable->equalstyle(ivariable)) kindflag = GLOBAL;")
set(none "      if (ivariable < 0) error->all(FLERR,\"Variable name for fix ave/histo does not exist\");\n")
mend(fix_ave_histo.cpp "${find}${equal}" "${find}${none}${equal}"
     "a variable that does not exist crashes fix ave/histo")

# An index of ten digits or more becomes another one: `c_s[4294967297]` is c_s[1], and others lie outside the vector.
mend_message(variable.cpp "\n  int index = atoi(start);" "\n  int index = grainscope::whole_index(start);"
             "a long index in brackets is read as another index")
# `vx[99999]` looks for a grain beyond the table of grains.
mend(variable.cpp "\n  int index = atom->map(id);" "\n  int index = id <= atom->map_tag_max ? atom->map(id) : -1;"
     "a variable with the ID of a grain that does not exist reads memory that is not its own")

# print "${s_P}"
mend_message(input.cpp "error->one(FLERR,\"Substitution for illegal variable\");"
             "error->all(FLERR,grainscope::without_value(lmp,var).c_str());"
             "the message about a variable in a command does not name it")
