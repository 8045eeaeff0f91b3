mod estimate;
mod file;
mod journal;
mod run;
mod summary;
