(** * faint-long: A long ray through a faint, slowly varying medium

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  1 / 100000 * (1 + 1 / 2 * cos (1 / 50 * s)).
Definition emission (s : R) : R :=
  1 + 1 / 1000 * (s + 25 * sin (1 / 50 * s)).
Definition exact_depth (lambda : R) : R :=
  1 / 100000 * (lambda + 25 * sin (1 / 50 * lambda)).
Definition exact_radiance (lambda : R) : R :=
  101 - (101 + 1 / 1000 * (lambda + 25 * sin (1 / 50 * lambda))) * exp (-1 / 100000 * (lambda + 25 * sin (1 / 50 * lambda))).

Theorem faint_long (D : R) :
  0 <= D <= 1000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
