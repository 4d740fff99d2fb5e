// What a machine forgets that dies: contents that were not synced, names whose folder was not. For the preloaded
// library.
//
// The worst is taken: nothing is kept that no sync asked for, and what a failed sync covered is lost for good, whatever
// later ones say, unless the file is emptied and written anew. A removal counts as durable at once, and so does the
// bare name of a new file.
#pragma once

/// Where copies are kept: this name and a number behind it.
void unsynced_keep_beside(const char* prefix);

void unsynced_before_change(const char* file);
void unsynced_before_truncation(const char* file, long long size);
void unsynced_after_sync(const char* path, int result);
void unsynced_before_rename(const char* to);
void unsynced_after_rename(const char* from, const char* to, int result);
void unsynced_after_making(const char* folder);
void unsynced_after_removal(const char* file);

/// The machine dies: everything is as it was when it was last synced.
void unsynced_lose(void);
