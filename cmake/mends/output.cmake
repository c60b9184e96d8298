# Output that does not reach its file.

# The host does not look whether its output arrives.
set(unwritten "error->one(FLERR,\"Output cannot be written: is the disk full?\");")
set(close "\n  if (multifile) {\n    if (compressed) {\n      if (filewriter) pclose(fp);\n    } else {\n      if (filewriter) ")
mend(dump.cpp "${close}fclose(fp);" "${close}if (ferror(fp) | fclose(fp)) ${unwritten}" "a dump that is not written is no error")
mend(dump.cpp "\n  // if file per timestep, close" "\n  if (!multifile && filewriter && fp && ferror(fp)) ${unwritten}\n  // if file per timestep, close" "likewise")
foreach(indent "      " "    ")
  mend(write_restart.cpp "\n${indent}fclose(fp);\n" "\n${indent}if (ferror(fp) | fclose(fp)) ${unwritten}\n" "a restart file that is not written is no error")
endforeach()
foreach(name fix_ave_time fix_ave_histo fix_ave_spatial fix_ave_correlate fix_print)
  mend(${name}.cpp "fflush(fp);" "if (fflush(fp) != 0 || ferror(fp)) ${unwritten}" "a table that is not written is no error")
endforeach()
mend(write_data.cpp "\n  if (me == 0) fclose(fp);\n" "\n  if (me == 0 && (ferror(fp) | fclose(fp))) ${unwritten}\n"
     "a data file that is not written is no error")

# Headings of variables are cut after 8 letters: v_stress_mu_eff would be stress_m, as v_stress_mean.
mend(thermo.cpp "      char copy[9];\n      strncpy(copy,id,8);\n      copy[8] = '\\0';\n"
     "      char copy[32] = {0};\n      strncpy(copy,id,word[0] == 'v' ? 31 : 8);\n"
     "thermo headings cut the names of variables")
mend(thermo.cpp "format[i] = new char[32];" "format[i] = new char[96];" "room for them")
