# Output that does not reach its file.

# LIGGGHTS does not check whether its output was written.
set(unwritten "error->one(FLERR,\"Output cannot be written: is the disk full?\");")
set(close "
  if (multifile) {
    if (compressed) {
      if (filewriter) pclose(fp);
    } else {
      if (filewriter) ")
set(per_step "\n  // if file per timestep, close")
mend(dump.cpp "${close}fclose(fp);" "${close}if (ferror(fp) | fclose(fp)) ${unwritten}"
     "a dump that cannot be written gives no error")
mend(dump.cpp "${per_step}" "\n  if (!multifile && filewriter && fp && ferror(fp)) ${unwritten}${per_step}"
     "a dump in one file that cannot be written gives no error")
foreach(indent "      " "    ")
  mend(write_restart.cpp "\n${indent}fclose(fp);\n" "\n${indent}if (ferror(fp) | fclose(fp)) ${unwritten}\n"
       "a restart file that cannot be written gives no error")
endforeach()
foreach(name fix_ave_time fix_ave_histo fix_ave_spatial fix_ave_correlate fix_print)
  mend(${name}.cpp "fflush(fp);" "if (fflush(fp) != 0 || ferror(fp)) ${unwritten}"
       "a table that cannot be written gives no error")
endforeach()
mend(write_data.cpp "\n  if (me == 0) fclose(fp);\n" "\n  if (me == 0 && (ferror(fp) | fclose(fp))) ${unwritten}\n"
     "a data file that cannot be written gives no error")

# Headings of variables are cut after 8 letters: v_stress_mu_eff and v_stress_mean would both be stress_m.
mend(thermo.cpp "      char copy[9];\n      strncpy(copy,id,8);\n      copy[8] = '\\0';\n"
     "      char copy[32] = {0};\n      strncpy(copy,id,word[0] == 'v' ? 31 : 8);\n"
     "thermo headings cut the names of variables after 8 letters")
mend(thermo.cpp "format[i] = new char[32];" "format[i] = new char[96];" "room for longer headings")
