//! Everything that a person sees: terminal, reports and pages.

mod first_screen;
mod hostile_names;
mod one_number;
mod pages;
mod reports;
mod terminal;
