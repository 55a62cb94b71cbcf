/// The subcommands. argv[0] is the subcommand's name; the result is the exit status: 0 done, 1 bad input, 2 wrong usage, 3 environment
/// failed.
#ifndef COMMANDS_COMMANDS_H
#define COMMANDS_COMMANDS_H

int command_live(int argc, char **argv);
int command_solve(int argc, char **argv);
int command_rig(int argc, char **argv);
int command_export(int argc, char **argv);
int command_check(int argc, char **argv);
int command_log(int argc, char **argv);
int command_simulate(int argc, char **argv);
int command_analyze(int argc, char **argv);

#endif
