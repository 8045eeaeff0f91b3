(** * thick-back: A lamp behind a wall of depth 50

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  50.
Definition emission (s : R) : R :=
  exp (70 * s - 70).
Definition exact_depth (lambda : R) : R :=
  50 * lambda.
Definition exact_radiance (lambda : R) : R :=
  5 / 2 * (exp (20 * lambda) - 1) * exp (-70).

Theorem thick_back (D : R) :
  0 <= D <= 1 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
