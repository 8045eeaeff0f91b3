(** * even-emission: A source that is the same everywhere, in a medium that thins out

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  3 / 10 * exp (-1 / 10 * s).
Definition emission (s : R) : R :=
  2.
Definition exact_depth (lambda : R) : R :=
  3 - 3 * exp (-1 / 10 * lambda).
Definition exact_radiance (lambda : R) : R :=
  2 - 2 * exp (- (3 - 3 * exp (-1 / 10 * lambda))).

Theorem even_emission (D : R) :
  0 <= D <= 50 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
